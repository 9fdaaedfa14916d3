// Converts VecGeom's paths to navjit's states, by arithmetic, and back, by the changed levels.
#pragma once

#include <VecGeom/navigation/NavigationState.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "navjit/errors.hpp"
#include "navjit/navigator.hpp"

namespace navjit::vecgeom {

using ::vecgeom::NavigationState;
using Levels = std::span<const kernels::StackLevel>;  ///< Navigator::levels()

/// Tables of one world, by the numbers of its placed volumes and of the detector's volumes. A path
/// of VecGeom is the numbers of the placed volumes from the world down; assemblies are among them,
/// but have no touchables. Immutable once filled in.
///
/// Values of a path are read and written one by one and never as vectors: a wide load would wait
/// for what was just written in parts.
class Paths {
 public:
  using Index = NavigationState::Value_t;

  /// What a placed volume adds to a path.
  struct Node {
    TouchableId offset = nowhere;  ///< added to the touchable of what it is placed in
    VolumeId volume = 0;
    bool level = false;  ///< false for assemblies
  };

  /// For the conversion, by the number of the placed volume.
  std::vector<Node> nodes{};
  /// By volume: where its first daughter is in `placed`. There: where `indices` holds the placed
  /// volumes that a path to the daughter adds, which are assemblies and the daughter itself.
  std::vector<std::uint32_t> first{}, placed{};
  std::vector<Index> indices{};
  std::vector<TouchableId> touchables{};  ///< by volume: those of one placement
  Index world{};
  bool assemblies = false;  ///< whether there are any assemblies

  /// The state of a path. A path of another world, or one that does not begin with the world, gives
  /// a state that no detector has.
  State state(const NavigationState& path) const {
    return read(path, [](int, Index) {});
  }
  /// The same, and copies the values of the path. Throws UsageError if `out` has too little room.
  State state(const NavigationState& path, NavigationState& out) const {
    const int length = path.GetCurrentLevel();
    if (length > out.GetMaxLevel() + 1) [[unlikely]]
      refuse_room();
    // What was left last is below the path's end, if there is room for it.
    if (length <= std::min(path.GetMaxLevel(), out.GetMaxLevel()))
      out.SetValueAt(length, path.ValueAt(length));
    return read(path, [&](int i, Index value) {
      out.SetValueAt(i, value);
      asm volatile("" : : : "memory");
    });
  }

  /// Makes `out`, which has the values of `in`, the path to where the navigator is, which came
  /// there from the state of `in`. Below the end it writes what was left last, as VecGeom wants it,
  /// unless a volume was entered. Throws UsageError if `out` has too little room.
  void write(const NavigationState& in, const State& from, Levels to, NavigationState& out) const {
    const int depth = static_cast<int>(to.size());
    int common = depth;
    while (common > 0 && !holds(to[common - 1], from)) --common;
    set_length(out, assemblies ? length_of(in, common) : common);
    if (common == depth) return;
    if (common == 0) push(out, world), ++common;
    for (; common < depth; ++common) push_daughter(out, to[common - 1].volume, to[common].daughter);
    forget_last_exited(out);
  }

  /// The daughter of the state of `in` that the navigator, coming from there, is now in, directly
  /// or deeper; negative: none.
  int entered(const NavigationState& in, const State& from, Levels to) const {
    std::size_t depth = 0;
    for (int i = 0; i < in.GetCurrentLevel(); ++i) depth += nodes[number(in.ValueAt(i))].level;
    if (to.size() <= depth || depth == 0 || !holds(to[depth - 1], from)) return -1;
    return static_cast<int>(to[depth].daughter);
  }

  /// Adds the placed volumes on the way from a volume to its daughter.
  void push_daughter(NavigationState& path, VolumeId mother, std::uint32_t daughter) const {
    const std::uint32_t at = first[mother] + daughter;
    for (std::uint32_t i = placed[at]; i < placed[at + 1]; ++i) push(path, indices[i]);
  }
  static void push(NavigationState& path, Index index) {
    if (path.GetCurrentLevel() > path.GetMaxLevel()) [[unlikely]]
      refuse_room();
    path.PushIndexType(index);
  }
  /// VecGeom's navigators do not enter again what is named below the path's end. The world serves
  /// there, since nothing contains it.
  void forget_last_exited(NavigationState& path) const {
    if (path.GetCurrentLevel() <= path.GetMaxLevel())
      path.SetValueAt(path.GetCurrentLevel(), world);
  }
  /// For a path whose values are already there.
  static void set_length(NavigationState& path, int length) {
#ifdef VECGEOM_CACHED_TRANS
    path.Clear();
#endif
    while (path.GetCurrentLevel() > length) path.Pop();
    while (path.GetCurrentLevel() < length)
      path.PushIndexType(path.ValueAt(path.GetCurrentLevel()));
    path.SetCacheValue(-1);
  }

 private:
  static constexpr TouchableId nowhere = TouchableId{1} << 62;

  template <class Each>
  State read(const NavigationState& path, Each&& each) const {
    static constexpr Node none{};
    const Node* const table = nodes.data();
    const std::size_t size = nodes.size();
    const int length = path.GetCurrentLevel();
    if (length == 0) return {};
    TouchableId touchable = 0, all = path.ValueAt(0) == world ? 0 : nowhere;
    const Node* node = &none;
    for (int i = 0; i < length; ++i) {
      const Index value = path.ValueAt(i);
      const std::size_t index = number(value);
      node = index < size ? table + index : &none;
      touchable += node->offset;
      all |= node->offset;
      each(i, value);
    }
    return {all < nowhere ? touchable : nowhere, node->volume};
  }

  /// Whether a level is the state's or one above it: touchables are numbered in preorder.
  bool holds(const kernels::StackLevel& level, const State& state) const {
    return state.touchable() - level.touchable < touchables[level.volume];
  }

  /// The length of the path down to that many levels that have touchables.
  int length_of(const NavigationState& path, int levels) const {
    int length = 0;
    while (levels > 0) levels -= nodes[number(path.ValueAt(length++))].level;
    return length;
  }

  [[noreturn]] static void refuse_room() {
    throw UsageError(
        "the VecGeom state has room for fewer levels than the path: make it with "
        "NavigationState::MakeInstance(GeoManager::Instance().getMaxDepth())");
  }

  template <class T>
  static std::size_t number(T index) {
    if constexpr (std::is_pointer_v<T>)
      return index->id();
    else
      return index;
  }
};

}  // namespace navjit::vecgeom
