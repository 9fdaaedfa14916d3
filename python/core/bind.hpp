// The parts of the module, a file for each.
#pragma once

#include <pybind11/pybind11.h>

namespace navjit::python {

namespace py = pybind11;

// Each adds its classes and functions to the module; errors first.
void bind_errors(py::module_& module);
void bind_states(py::module_& module);
void bind_detector(py::module_& module);
void bind_runtime(py::module_& module);
void bind_navigator(py::module_& module);

}  // namespace navjit::python
