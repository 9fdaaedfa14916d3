// The instances of the scene template that the library has. One frame is one file, so that they are
// compiled side by side.
#pragma once

#include "codegen/data/bind.hpp"
#include "codegen/data/parts.hpp"
#include "geometry/navigation/thread_sanitizer.hpp"

namespace navjit::codegen {

/// Binds the plan to the instance for its mother, daughters and search in this kind of frame.
const kernels::DispatchEntry* bind_unrotated(const Geometry& geometry, const ScenePlan& plan,
                                             Arena& arena);
const kernels::DispatchEntry* bind_turned(const Geometry& geometry, const ScenePlan& plan,
                                          Arena& arena);
const kernels::DispatchEntry* bind_any_frame(const Geometry& geometry, const ScenePlan& plan,
                                             Arena& arena);

/// Whether all daughters are boxes without rotation.
bool all_boxes(const Scene& scene);
bool all_of_kind(const Scene& scene, SolidKind kind);

namespace detail {

template <class S>
[[gnu::flatten]] double step_of(NavigationStack* stack, const kernels::Context* context,
                                const void* data, double x, double y, double z, double limit) {
  tell_received(data);
  return kernels::step_in<S>(data, stack, context, x, y, z, limit);
}
template <class S>
[[gnu::flatten]] void relocate_of(NavigationStack* stack, const kernels::Context* context,
                                  const void* data, double x, double y, double z, int blocked) {
  tell_received(data);
  kernels::relocate_in<S>(data, stack, context, x, y, z, blocked);
}
template <class S>
[[gnu::flatten]] double safety_of(const NavigationStack* stack, const kernels::Context*,
                                  const void* data, double x, double y, double z, double enough) {
  tell_received(data);
  return kernels::safety_in<S>(data, stack, x, y, z, enough);
}

kernels::SafetyFunction generic_safety();

template <class Frame, class Mother, class Daughters, class Search>
const kernels::DispatchEntry* bind(const Geometry& geometry, const ScenePlan& plan, Arena& arena) {
  using S = kernels::Scene<Frame, Mother, Daughters, Search>;
  /// The record and the numbers that it is for, one after the other.
  struct Record {
    kernels::DispatchEntry entry;
    S scene;
  };
  const Source source{geometry, plan, geometry.scene(plan.volume), arena};
  Record& record = *arena.array<Record>(1);
  S& scene = record.scene;
  scene.tolerance = geometry.tolerance();
  make(source, scene.frame);
  make(source, scene.mother);
  make(source, scene.daughters);
  make(source, scene.search);
  make_shared_tables(source, scene);
  // Another search may be bound in the place of the one that the plan's safety is for.
  const bool left_to_generic =
      plan.safety == SafetyFrom::generic ||
      (plan.safety == SafetyFrom::wires && plan.candidates != Candidates::wires);
  const auto safety = left_to_generic ? generic_safety() : &safety_of<S>;
  record.entry = {&step_of<S>, &relocate_of<S>, safety, &scene};
  return &record.entry;
}

template <class Frame, class Mother, class Daughters>
const kernels::DispatchEntry* bind_search(const Geometry& geometry, const ScenePlan& plan,
                                          Arena& arena) {
  switch (plan.candidates) {
    case Candidates::none:
    case Candidates::all:
      break;
    case Candidates::lanes:
      if constexpr (std::is_same_v<Daughters, kernels::BoxDaughters>) {
        return geometry.scene(plan.volume).daughters.size() <= kernels::lanes_of_four
                   ? bind<Frame, Mother, Daughters, Lanes<1>>(geometry, plan, arena)
                   : bind<Frame, Mother, Daughters, Lanes<2>>(geometry, plan, arena);
      }
      break;
    case Candidates::slabs:
      return bind<Frame, Mother, Daughters, kernels::SearchSlabs<Index>>(geometry, plan, arena);
    case Candidates::grid:
      return bind<Frame, Mother, Daughters, kernels::SearchGrid<Index>>(geometry, plan, arena);
    case Candidates::boxes:
      return bind<Frame, Mother, Daughters, kernels::SearchBoxes<Index>>(geometry, plan, arena);
    case Candidates::layers:
      return bind<Frame, Mother, Daughters, kernels::SearchLayers<Index>>(geometry, plan, arena);
    case Candidates::tree:
      return bind<Frame, Mother, Daughters, SearchTree>(geometry, plan, arena);
    case Candidates::nest:
      return bind<Frame, Mother, AnyDaughters, kernels::SearchNest<Index>>(geometry, plan, arena);
    case Candidates::wires: {
      using Wires =
          std::conditional_t<std::is_same_v<Daughters, TubeDaughters>, Daughters, AnyDaughters>;
      return bind<Frame, Mother, Wires, kernels::SearchWires<Index>>(geometry, plan, arena);
    }
    case Candidates::rings:
      return bind<Frame, Mother, AnyDaughters, kernels::SearchRings<Index>>(geometry, plan, arena);
  }
  return bind<Frame, Mother, Daughters, kernels::SearchAll>(geometry, plan, arena);
}

template <class Frame, class Mother>
const kernels::DispatchEntry* bind_daughters(const Geometry& geometry, const ScenePlan& plan,
                                             Arena& arena) {
  const Scene& scene = geometry.scene(plan.volume);
  if (scene.daughters.empty()) {
    return bind<Frame, Mother, kernels::NoDaughters, kernels::NoSearch>(geometry, plan, arena);
  }
  if (all_boxes(scene))
    return bind_search<Frame, Mother, kernels::BoxDaughters>(geometry, plan, arena);
  if (all_of_kind(scene, SolidKind::tube))
    return bind_search<Frame, Mother, TubeDaughters>(geometry, plan, arena);
  return bind_search<Frame, Mother, AnyDaughters>(geometry, plan, arena);
}

template <class Frame>
const kernels::DispatchEntry* bind_mother(const Geometry& geometry, const ScenePlan& plan,
                                          Arena& arena) {
  switch (geometry.scene(plan.volume).solid.kind) {
    case SolidKind::box:
      return bind_daughters<Frame, kernels::Box<double>>(geometry, plan, arena);
    case SolidKind::tube:
      return bind_daughters<Frame, kernels::Tube<double>>(geometry, plan, arena);
    default:
      return bind_daughters<Frame, kernels::QuickSolid>(geometry, plan, arena);
  }
}

}  // namespace detail
}  // namespace navjit::codegen
