// The instances of the scene template that the library has. There is one file for each kind of
// frame, so that they are compiled in parallel.
#pragma once

#include "codegen/data/bind.hpp"
#include "codegen/data/parts.hpp"
#include "geometry/navigation/thread_sanitizer.hpp"

namespace navjit::codegen {

/// Binds the plan to the instance for its mother, daughters and search in this kind of frame.
const kernels::DispatchEntry* bind_unrotated(const Source& source);
const kernels::DispatchEntry* bind_turned(const Source& source);
const kernels::DispatchEntry* bind_any_frame(const Source& source);

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

/// Whether a search computes the safety whatever the plan says, because it may be bound in the
/// place of the search for which the plan was made.
template <class Search>
constexpr bool has_safety = false;
template <class Index>
constexpr bool has_safety<kernels::SearchLayers<Index>> = true;

template <class Frame, class Mother, class Daughters, class Search>
const kernels::DispatchEntry* bind(const Source& source) {
  using S = kernels::Scene<Frame, Mother, Daughters, Search>;
  /// The entry and the numbers that it refers to, one after the other.
  struct Record {
    kernels::DispatchEntry entry;
    S scene;
  };
  Record& record = *source.arena.array<Record>(1);
  S& scene = record.scene;
  scene.tolerance = source.geometry.tolerance();
  make(source, scene.frame);
  make(source, scene.mother);
  make(source, scene.daughters);
  make(source, scene.search);
  make_shared_tables(source, scene);
  const bool left_to_generic =
      !has_safety<Search> &&
      (source.plan.safety == SafetyFrom::generic ||
       (source.plan.safety == SafetyFrom::wires && source.plan.candidates != Candidates::wires));
  const auto safety = left_to_generic ? generic_safety() : &safety_of<S>;
  record.entry = {&step_of<S>, &relocate_of<S>, safety, &scene, &scene};
  return &record.entry;
}

template <class Frame, class Mother, class Daughters>
const kernels::DispatchEntry* bind_search(const Source& source) {
  switch (source.plan.candidates) {
    case Candidates::none:
    case Candidates::all:
      break;
    case Candidates::lanes:
      if constexpr (std::is_same_v<Daughters, kernels::BoxDaughters>) {
        return source.scene.daughters.size() <= kernels::lanes_of_four
                   ? bind<Frame, Mother, Daughters, Lanes<1>>(source)
                   : bind<Frame, Mother, Daughters, Lanes<2>>(source);
      }
      break;
    case Candidates::slabs:
      return bind<Frame, Mother, Daughters, kernels::SearchSlabs<Index>>(source);
    case Candidates::grid:
      return bind<Frame, Mother, Daughters, kernels::SearchGrid<Index>>(source);
    case Candidates::boxes:
      return bind<Frame, Mother, Daughters, kernels::SearchBoxes<Index>>(source);
    case Candidates::scan:
      return bind<Frame, Mother, Daughters, kernels::SearchScan>(source);
    case Candidates::groups:
      return bind<Frame, Mother, Daughters, kernels::SearchGroups>(source);
    case Candidates::layers:
      return bind<Frame, Mother, Daughters, kernels::SearchLayers<Index>>(source);
    case Candidates::tree:
      return bind<Frame, Mother, Daughters, SearchTree>(source);
    case Candidates::nest:
      return bind<Frame, Mother, AnyDaughters, kernels::SearchNest<Index>>(source);
    case Candidates::wires: {
      using Wires =
          std::conditional_t<std::is_same_v<Daughters, TubeDaughters>, Daughters, AnyDaughters>;
      return bind<Frame, Mother, Wires, kernels::SearchWires<Index>>(source);
    }
    case Candidates::rings:
      return bind<Frame, Mother, AnyDaughters, kernels::SearchRings<Index>>(source);
  }
  return bind<Frame, Mother, Daughters, kernels::SearchAll>(source);
}

template <class Frame, class Mother>
const kernels::DispatchEntry* bind_daughters(const Source& source) {
  const Scene& scene = source.scene;
  if (scene.daughters.empty()) {
    return bind<Frame, Mother, kernels::NoDaughters, kernels::NoSearch>(source);
  }
  if (all_boxes(scene)) return bind_search<Frame, Mother, kernels::BoxDaughters>(source);
  if (all_of_kind(scene, SolidKind::tube)) return bind_search<Frame, Mother, TubeDaughters>(source);
  return bind_search<Frame, Mother, AnyDaughters>(source);
}

template <class Frame>
const kernels::DispatchEntry* bind_mother(const Source& source) {
  switch (source.scene.solid.kind) {
    case SolidKind::box:
      return bind_daughters<Frame, kernels::Box<double>>(source);
    case SolidKind::tube:
      return bind_daughters<Frame, kernels::Tube<double>>(source);
    default:
      return bind_daughters<Frame, kernels::QuickSolid>(source);
  }
}

}  // namespace detail
}  // namespace navjit::codegen
