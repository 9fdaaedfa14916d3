// What the generic navigator reads of a scene at every step, in whole cache lines. In a detector of
// thousands of volumes little of this is in a cache, and a step waits for every line that it
// touches.
#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "geometry/navigation/navigation_stack.hpp"
#include "geometry/navigation/neighbours.hpp"

namespace navjit {

struct Scene;
namespace bvh {
class BoxTree;
}

/// How a scene's daughters are searched.
enum class Search : std::uint8_t { none, all, linear_boxes, bvh };

constexpr std::size_t cache_line = 64;

/// A daughter: one cache line. Its solid and its rotation are elsewhere; daughters whose bits are
/// equal share them.
struct alignas(cache_line) PackedDaughter {
  double translation[3];
  const double* rotation;  ///< outer-to-local, row-major; null: the identity
  kernels::AnySolid<double> solid;
  TouchableId offset;
  VolumeId volume;
};
static_assert(sizeof(PackedDaughter) == cache_line);

/// A logical volume: one cache line.
struct alignas(cache_line) PackedScene {
  kernels::AnySolid<double> solid;
  const PackedDaughter* daughters;
  const bvh::BoxTree* boxes;        ///< null: none
  const NeighbourLists::Of* lists;  ///< by daughter; null: not known
  const std::uint32_t* neighbours;  ///< as `lists` refers to them
  const kernels::BoxBlock* blocks;  ///< the neighbours' boxes, likewise
  std::uint32_t count;              ///< the number of daughters
  Search search;
};
static_assert(sizeof(PackedScene) == cache_line);

/// By volume. It points into the scenes that it was made from, and into the solids of their world:
/// those have to outlive it.
class PackedScenes {
 public:
  PackedScenes() = default;
  explicit PackedScenes(std::span<const Scene> scenes);

  const PackedScene& operator[](VolumeId volume) const { return scenes_[volume]; }
  /// For daughter_holding().
  double daughters_per_touchable(VolumeId volume) const { return per_touchable_[volume]; }

 private:
  std::vector<PackedScene> scenes_;
  std::vector<PackedDaughter> daughters_;
  std::vector<double> per_touchable_;
  /// Holds shapes and rotations.
  std::unique_ptr<std::pmr::monotonic_buffer_resource> memory_;
};

}  // namespace navjit
