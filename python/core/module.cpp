// navjit._core: the compiled part of the Python package (docs/python.md).
#include <navjit/version.hpp>

#include "python/core/bind.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of navjit; use it by `import navjit`.";
  module.attr("__version__") = navjit::version();
  navjit::python::bind_errors(module);
  navjit::python::bind_states(module);
  navjit::python::bind_detector(module);
  navjit::python::bind_navigator(module);
  navjit::python::bind_runtime(module);
}
