// Reports as dicts, with the keys of docs/report.md.
#pragma once

#include <navjit/observation.hpp>
#include <navjit/report.hpp>

#include "python/core/bind.hpp"

namespace navjit::python {

py::dict dict_of(const RuntimeReport& report);
py::dict dict_of(const ObservedDetector& seen);

}  // namespace navjit::python
