// One point at a time: for programs that follow single tracks, and for trying things out.
#include <cmath>
#include <limits>

#include "python/core/arrays.hpp"
#include "python/core/engine.hpp"
#include "python/core/navigator.hpp"

namespace navjit::python {
namespace {

py::array_t<double> array_of(const Vec3& v) {
  py::array_t<double> array(3);
  array.mutable_at(0) = v.x;
  array.mutable_at(1) = v.y;
  array.mutable_at(2) = v.z;
  return array;
}

State known(const PythonNavigator& n, const py::object& given) {
  const State state = state_of(given);
  if (state.inside()) n.engine->require_known(state);
  return state;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

void bind_navigator(py::module_& module) {
  // The interpreter's lock is kept: calls are short, and it makes them one at a time.
  using N = PythonNavigator;
  py::class_<N>(module, "Navigator",
                "Answers for one point at a time; made by Runtime.navigator(). Points are mm, "
                "directions of unit length, both in the world's frame.")
      .def(
          "locate",
          [](N& n, const py::object& point, const py::object& direction) {
            const Vec3 at = vector_of(point, "point");
            return direction.is_none() ? n.navigator.locate(at)
                                       : n.navigator.locate(at, vector_of(direction, "direction"));
          },
          py::arg("point"), py::arg("direction") = py::none(),
          "The deepest touchable with the point, or outside. On a face the direction decides.")
      .def(
          "step",
          [](N& n, const py::object& state, const py::object& point, const py::object& direction,
             double limit) {
            const Step step =
                n.engine->seen().step(n.navigator, known(n, state), vector_of(point, "point"),
                                      vector_of(direction, "direction"), limit);
            return py::module_::import("navjit.results")
                .attr("Step")(step.length, step.boundary, step.next);
          },
          py::arg("state"), py::arg("point"), py::arg("direction"), py::arg("limit") = infinity,
          "One step, at most limit mm: Step(length, boundary, next).")
      .def(
          "safety",
          [](N& n, const py::object& state, const py::object& point, double enough) {
            return n.navigator.safety(known(n, state), vector_of(point, "point"), enough);
          },
          py::arg("state"), py::arg("point"), py::arg("enough") = infinity,
          "A lower bound of the distance to the nearest boundary, mm, or enough if that is less.")
      .def(
          "relocate",
          [](N& n, const py::object& hint, const py::object& point, const py::object& direction) {
            return n.navigator.relocate(known(n, hint), vector_of(point, "point"),
                                        vector_of(direction, "direction"));
          },
          py::arg("hint"), py::arg("point"), py::arg("direction"),
          "As locate(), for a point in the touchable of the hint or near it.")
      .def(
          "normal",
          [](N& n, const py::object& state, const py::object& point) {
            return array_of(n.navigator.normal(known(n, state), vector_of(point, "point")));
          },
          py::arg("state"), py::arg("point"),
          "The outward unit normal of the state's volume at a point on its surface.")
      .def(
          "to_local",
          [](N& n, const py::object& state, const py::object& point) {
            return array_of(n.navigator.to_local(known(n, state), vector_of(point, "point")));
          },
          py::arg("state"), py::arg("point"), "A point of the world in the state's frame, mm.")
      .def(
          "to_global",
          [](N& n, const py::object& state, const py::object& point) {
            return array_of(n.navigator.to_global(known(n, state), vector_of(point, "point")));
          },
          py::arg("state"), py::arg("point"), "The inverse.")
      .def_property_readonly(
          "counts",
          [](const N& n) {
            const NavigatorCounts& c = n.navigator.counts();
            py::dict counts;
            counts["bail_outs"] = c.bail_outs;
            counts["differences"] = c.differences;
            counts["restored"] = c.restored;
            counts["within_safety"] = c.within_safety;
            return counts;
          },
          "What it did so far.");
}

}  // namespace navjit::python
