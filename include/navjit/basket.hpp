// Many tracks at once, for programs that carry them so: structure of arrays in and out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/navigator.hpp"

namespace NAVJIT_API navjit {

class StackPool;

/// Tracks, one element each of every array.
struct Tracks {
  std::span<const State> state;     ///< where they are; outside the world there is nothing to do
  std::span<const double> x, y, z;  ///< points, global, mm
  std::span<const double> u, v, w;  ///< directions, of unit length
  std::span<const double> limit{};  ///< of steps, mm; empty: none has one
};

/// Where steps are written: as many elements as there are tracks. `next` may be the memory of
/// Tracks::state.
struct Steps {
  std::span<double> length;          ///< mm; 0 for tracks outside the world
  std::span<std::uint8_t> boundary;  ///< 1 where a boundary ended the step, else 0
  std::span<State> next;             ///< fully located
};

/// Steps many tracks at once, with the bits of Navigator::step for each. Tracks in the same volume
/// are stepped one after the other, whatever their order in the arrays, so that code and numbers of
/// a volume serve all of them while the processor has them at hand. Each place in the arrays has a
/// navigation stack of its own: a track that keeps its place from call to call continues where it
/// is, and one that changes it is brought there first, as with Navigator.
///
/// One per thread, from Runtime::basket(); keeps the runtime's data alive.
class Basket {
 public:
  /// What was moved from may only be destroyed.
  Basket(Basket&&) noexcept;
  Basket& operator=(Basket&&) = delete;
  ~Basket();

  /// How many places keep their stacks. Arrays may be longer: then places share them.
  std::size_t places() const;

  /// As Navigator::locate, for a track that is to be in this place: its first step begins there.
  /// Throws as that, and UsageError if there is no such place.
  State locate(std::size_t place, const Vec3& point, const Vec3& direction);

  /// As Navigator::step, for each track. Throws UsageError that names the first bad element, or the
  /// array that is not of the others' length; then no step was made and nothing was written. (A
  /// state of another world may be found out later: then some tracks have made theirs.)
  void step(const Tracks& tracks, const Steps& steps);

  /// What this basket did so far.
  const NavigatorCounts& counts() const { return navigator_.counts(); }

 private:
  friend class Runtime;
  /// Throws UsageError if there is to be no place.
  Basket(Navigator navigator, std::size_t places);
  /// The numbers of those tracks that are in the world into order_, by volume.
  void sort(std::span<const State> state);

  Navigator navigator_;
  std::unique_ptr<StackPool> stacks_;
  std::vector<std::uint32_t> order_, first_;  ///< tracks in order; by volume, where it begins
  std::vector<VolumeId> volumes_;             ///< those of the tracks at hand
};

}  // namespace navjit
