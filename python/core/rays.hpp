// Whole rays, from where they start until they leave the world.
#pragma once

#include "python/core/engine.hpp"

namespace navjit::python {

/// Every step of every ray: navjit.results.Trace. Throws UsageError that names the first bad ray.
py::object trace(Engine& engine, const py::object& points, const py::object& directions);
/// What rays go through: navjit.results.Scan. `by_material`: also for each material.
py::object scan(Engine& engine, const py::object& points, const py::object& directions,
                bool by_material);

}  // namespace navjit::python
