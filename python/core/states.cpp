// States, and the numpy type of arrays of them.
#include "python/core/arrays.hpp"

namespace navjit::python {
namespace {

std::string text_of(const State& state) {
  if (!state.inside()) return "State(outside)";
  return "State(touchable=" + std::to_string(state.touchable()) +
         ", volume=" + std::to_string(state.volume()) + ")";
}

}  // namespace

void bind_states(py::module_& module) {
  module.attr("state_dtype") = state_dtype();
  py::class_<State>(module, "State",
                    "Where a track is: a touchable, or outside the world. A small value.")
      .def(py::init<>(), "Outside the world.")
      .def(py::init<TouchableId, VolumeId>(), py::arg("touchable"), py::arg("volume"),
           "Of both numbers, for those who stored them.")
      .def_property_readonly("inside", &State::inside, "Whether it is in the world.")
      .def_property_readonly("touchable", &State::touchable,
                             "The number of the touchable in the tree, in preorder.")
      .def_property_readonly("volume", &State::volume,
                             "The number of the logical volume; none outside the world.")
      .def("__bool__", &State::inside)
      .def(
          "__eq__", [](const State& a, const State& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const State& s) { return std::hash<State>{}(s); })
      .def("__repr__", &text_of)
      .def(py::pickle(
          [](const State& s) { return py::make_tuple(s.inside(), s.touchable(), s.volume()); },
          [](const py::tuple& t) {
            return t[0].cast<bool>() ? State(t[1].cast<TouchableId>(), t[2].cast<VolumeId>())
                                     : State();
          }));
}

}  // namespace navjit::python
