// Exceptions, with the names that they have in C++.
#include <navjit/errors.hpp>
#include <navjit/root.hpp>

#include "python/core/bind.hpp"

namespace navjit::python {
namespace {

/// Translators are asked in the reverse order of their registration, so what derives comes later.
template <class Cpp>
py::object bind_error(py::module_& module, const char* name, const py::object& base,
                      const char* doc) {
  py::object error = py::register_exception<Cpp>(module, name, base);
  error.attr("__module__") = "navjit";
  error.attr("__doc__") = doc;
  return error;
}

}  // namespace

void bind_errors(py::module_& module) {
  const auto error =
      bind_error<Error>(module, "Error", py::reinterpret_borrow<py::object>(PyExc_RuntimeError),
                        "What navjit raises of its own: one line that says what is wrong.");
  // `except ValueError` takes these, too.
  const auto both = py::make_tuple(error, py::reinterpret_borrow<py::object>(PyExc_ValueError));
  bind_error<UsageError>(module, "UsageError", both,
                         "A call against the rules of its function. Nothing was changed.");
  bind_error<GeometryError>(module, "GeometryError", both, "A detector that cannot be.");
  bind_error<GdmlError>(module, "ParseError", both,
                        "A GDML or ROOT file that cannot be read: FILE:LINE: what is wrong.");
  // One name for both: a program has no other use for either.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const RootError& e) {
      const py::object parse_error = py::module_::import("navjit").attr("ParseError");
      PyErr_SetString(parse_error.ptr(), e.what());
    }
  });
}

}  // namespace navjit::python
