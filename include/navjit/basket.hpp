// Steps many tracks at once, for programs that keep their tracks as a structure of arrays.
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

/// Tracks: element i of every array belongs to track i.
struct Tracks {
  std::span<const State> state;     ///< the state of each; one outside the world is not stepped
  std::span<const double> x, y, z;  ///< points in the world's frame, mm
  std::span<const double> u, v, w;  ///< directions, of unit length
  std::span<const double> limit{};  ///< the longest step of each, mm; empty: no limits
};

/// Where the steps are written: every array has as many elements as there are tracks. `next` may be
/// the same memory as Tracks::state.
struct Steps {
  std::span<double> length;          ///< mm; 0 for tracks outside the world
  std::span<std::uint8_t> boundary;  ///< 1 where a boundary ended the step, else 0
  std::span<State> next;             ///< the state after the step, fully located
};

/// Steps many tracks at once; each step has the same bits as one of Navigator::step. Tracks in the
/// same volume are stepped one after the other, whatever their order in the arrays, so that the
/// code and the numbers of the volume serve all of them while they are in the processor's caches.
/// Each place in the arrays has its own navigation stack: a track that keeps its place from call to
/// call continues where it is; if it changed its place, the stack is rebuilt first.
///
/// One per thread, from Runtime::basket(); it keeps the runtime's data alive.
class Basket {
 public:
  /// A basket that was moved from may only be destroyed.
  Basket(Basket&&) noexcept;
  Basket& operator=(Basket&&) = delete;
  ~Basket();

  /// How many places have a navigation stack. In longer arrays, several places share one.
  std::size_t places() const;

  /// As Navigator::locate, for a track that is to be in this place: its first step begins there.
  /// Throws as Navigator::locate does, and UsageError if there is no such place.
  State locate(std::size_t place, const Vec3& point, const Vec3& direction);

  /// As Navigator::step, for each track. Throws UsageError, which names the first bad element, or
  /// the array whose length is not that of the others; then no step was made and nothing written.
  /// (A state of another world may be recognised later: then some steps were made.)
  void step(const Tracks& tracks, const Steps& steps);

  /// What this basket has counted so far.
  const NavigatorCounts& counts() const { return navigator_.counts(); }

 private:
  friend class Runtime;
  /// Throws UsageError if `places` is 0.
  Basket(Navigator navigator, std::size_t places);
  /// Sorts the numbers of those tracks that are in the world by volume, into order_.
  void sort(std::span<const State> state);

  Navigator navigator_;
  std::unique_ptr<StackPool> stacks_;
  std::vector<std::uint32_t> order_, first_;  ///< sorted tracks; by volume, the first of them
  std::vector<VolumeId> volumes_;             ///< those of the tracks at hand
};

}  // namespace navjit
