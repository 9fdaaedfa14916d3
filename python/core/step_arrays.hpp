// Questions about arrays of points: each answered as navjit::Navigator answers it.
#pragma once

#include "python/core/engine.hpp"

namespace navjit::python {

// Points and directions are (N, 3) or (3,), which stands for all. All throw UsageError that names
// the first bad element. Where a state is outside the world there is nothing to do: a length and a
// safety of 0, and the same state.

/// States. Without directions (None) a point on a face is in the first volume in file order.
py::object locate(Engine& engine, const py::object& points, const py::object& directions);
/// navjit.results.Steps; `out`: one to write to, or None.
py::object step(Engine& engine, const py::object& states, const py::object& points,
                const py::object& directions, const py::object& limit, const py::object& out);
/// The states of the original detector for those of the one that is navigated
/// (ObservedDetector::original). Without points and directions (None) a track may be deeper.
py::object original(Engine& engine, const py::object& states, const py::object& points,
                    const py::object& directions);
/// mm.
py::object safety(Engine& engine, const py::object& states, const py::object& points,
                  const py::object& enough);

}  // namespace navjit::python
