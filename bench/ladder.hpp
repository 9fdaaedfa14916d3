// What each promise of a step costs: recorded steps are repeated, and each rung of a ladder keeps
// one promise more.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

/// Each rung keeps the promises of those before it. The ladder stands on the floor
/// (bench/floor.hpp), which knows even the frames beforehand.
enum class Rung {
  frames,       ///< frames are composed level by level, on a stack; all choices are known
  nearest,      ///< the distance out of the volume is computed even if a daughter is nearer
  containment,  ///< a volume that the track enters, or returns to, has to contain the point
  search,       ///< nothing is known beforehand: the generic navigator's step
};
constexpr int rungs = 4;
const char* name_of(Rung rung);

/// Recorded steps of rays: which surface ends each, and which levels are then left and entered.
class Ladder {
 public:
  /// The sums of a run; they are the same on every rung, to the last bit, except `checks`.
  struct Sums {
    double length = 0;             ///< of all steps, mm
    std::uint64_t touchables = 0;  ///< sum of the numbers of those entered, but outside the world
    std::uint64_t checks = 0;      ///< how often a solid was asked whether it contains a point
    std::uint64_t denied = 0;      ///< how often the answer was no
  };

  /// `geometry` has to outlive this object.
  Ladder(const Geometry& geometry, const std::vector<Ray>& rays);

  Sums run(Rung rung) const;
  std::uint64_t steps() const { return steps_.size(); }

 private:
  struct RecordedStep {
    std::int32_t hit;         ///< the daughter that is met; -1: the volume's own surface
    std::uint32_t moves_end;  ///< in moves_
  };
  struct Start {
    Ray ray;
    TouchableId touchable;
    std::size_t end;  ///< in steps_
  };
  template <Rung rung>
  Sums climb() const;

  const Geometry* geometry_;
  std::vector<Start> starts_;
  std::vector<RecordedStep> steps_;
  std::vector<std::int32_t> moves_;  ///< after a step: a daughter to enter, or -1: leave a level
};

}  // namespace navjit::bench
