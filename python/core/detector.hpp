// The C++ detector of a Python one.
#pragma once

#include <navjit/detector.hpp>

#include "python/core/bind.hpp"

namespace navjit::python {

/// Lives as long as the object. Throws a Python TypeError for any other.
const Detector& detector_of(const py::object& given);

/// A Python one of it.
py::object python_detector(const Detector& detector);

}  // namespace navjit::python
