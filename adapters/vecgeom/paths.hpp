// VecGeom's paths and navjit's states: arithmetic one way, the levels that changed the other way.
#pragma once

#include <VecGeom/navigation/NavigationState.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "navjit/errors.hpp"
#include "navjit/navigator.hpp"

namespace navjit::vecgeom {

using ::vecgeom::NavigationState;

/// A path's levels without assemblies, which have no touchables.
struct PathLevels {
  int count;
  TouchableId touchable[256];
  std::uint8_t end[256];  ///< length of VecGeom's path down to this level
};

/// Tables of one world, by the numbers of its placed volumes and of the detector's volumes. A path
/// of VecGeom's is the numbers of the placed volumes from the world down, assemblies among them.
/// Immutable once filled in.
class Paths {
 public:
  using Index = NavigationState::Value_t;

  /// What a placed volume adds to a path.
  struct Node {
    TouchableId offset = nowhere;  ///< to the touchable of what it is placed in
    VolumeId volume = 0;
    bool level = false;  ///< not of an assembly
  };

  /// For the conversion: by the number of the placed volume.
  std::vector<Node> nodes{};
  /// By volume: where in `placed` its first daughter is. By that: where in `indices` are the placed
  /// volumes, assemblies and the daughter itself, that a path to the daughter has more.
  std::vector<std::uint32_t> first{}, placed{};
  std::vector<Index> indices{};
  Index world{};

  /// The state of a path, and its levels. That of a path of another world is of no detector.
  State state(const NavigationState& path, PathLevels& levels) const {
    return read<true>(path, &levels);
  }
  State state(const NavigationState& path) const { return read<false>(path, nullptr); }

  /// Makes a path with these levels the one that leads to where the navigator is. Levels that both
  /// have stay. Below the new end is what was left last, as VecGeom wants it, unless a volume was
  /// entered. Throws UsageError if the path has too little room.
  void move(NavigationState& path, const PathLevels& from,
            std::span<const kernels::StackLevel> to) const {
    const int depth = static_cast<int>(to.size());
    int common = std::min(from.count, depth);
    while (common > 0 && to[common - 1].touchable != from.touchable[common - 1]) --common;
    const int keep = common > 0 ? from.end[common - 1] : 0;
    while (path.GetCurrentLevel() > keep) path.Pop();
    if (common == depth) return;
    if (common == 0) push(path, world), ++common;
    for (; common < depth; ++common)
      push_daughter(path, to[common - 1].volume, to[common].daughter);
    forget_last_exited(path);
  }

  /// The placed volumes from a volume to its daughter.
  void push_daughter(NavigationState& path, VolumeId mother, std::uint32_t daughter) const {
    const std::uint32_t at = first[mother] + daughter;
    for (std::uint32_t i = placed[at]; i < placed[at + 1]; ++i) push(path, indices[i]);
  }
  static void push(NavigationState& path, Index index) {
    if (path.GetCurrentLevel() > path.GetMaxLevel()) [[unlikely]]
      refuse_room();
    path.PushIndexType(index);
  }
  /// VecGeom's navigators do not enter again what is named below the path's end; nothing contains
  /// the world.
  void forget_last_exited(NavigationState& path) const {
    if (path.GetCurrentLevel() <= path.GetMaxLevel())
      path.SetValueAt(path.GetCurrentLevel(), world);
  }
  [[noreturn]] static void refuse_room() {
    throw UsageError(
        "the VecGeom state has room for fewer levels than the path: make it with "
        "NavigationState::MakeInstance(GeoManager::Instance().getMaxDepth())");
  }

  /// As VecGeom's copies, but the room of either stays what it is.
  static void copy(const NavigationState& from, NavigationState& to) {
    if (from.GetMaxLevel() == to.GetMaxLevel()) [[likely]] {
      from.CopyTo(&to);
      return;
    }
    if (from.GetCurrentLevel() > to.GetMaxLevel() + 1) refuse_room();
    to = from;
  }

 private:
  static constexpr TouchableId nowhere = TouchableId{1} << 62;

  template <bool keep>
  State read(const NavigationState& path, [[maybe_unused]] PathLevels* levels) const {
    static constexpr Node none{};
    const int length = path.GetCurrentLevel();
    TouchableId touchable = 0;
    VolumeId volume = 0;
    int level = 0;
    for (int i = 0; i < length; ++i) {
      const std::size_t index = number(path.ValueAt(i));
      const Node& node = index < nodes.size() ? nodes[index] : none;
      touchable += node.offset;
      volume = node.volume;
      if constexpr (keep) {  // what an assembly wrote, the next level writes anew
        levels->touchable[level] = touchable;
        levels->end[level] = static_cast<std::uint8_t>(i + 1);
      }
      level += node.level;
    }
    if constexpr (keep) levels->count = level;
    return length == 0 ? State{} : State{touchable, volume};
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
