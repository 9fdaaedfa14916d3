// What each promise of a step costs: recorded steps made again, with one promise more on every
// rung.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

/// Each rung keeps the promises of those before it. The floor (bench/floor.hpp) is the ground: it
/// knows frames, too.
enum class Rung {
  frames,       ///< frames composed level by level, on a stack; choices are known
  nearest,      ///< the way out of the volume is asked for even if a daughter comes before it
  containment,  ///< what is gone back into, or further in, has to contain the point
  search,       ///< nothing is known: the generic navigator's step
};
constexpr int rungs = 4;
const char* name_of(Rung rung);

/// Recorded steps of rays: which surface ends each, and which levels are left and entered then.
class Ladder {
 public:
  /// What a climb adds up; the same on every rung, to the last bit, but for `checks`.
  struct Sums {
    double length = 0;             ///< mm, of all steps
    std::uint64_t touchables = 0;  ///< of where steps lead, those outside the world not counted
    std::uint64_t checks = 0;      ///< solids that were asked whether they contain a point
    std::uint64_t denied = 0;      ///< those of them that did not
  };

  /// `geometry` has to outlive it.
  Ladder(const Geometry& geometry, const std::vector<Ray>& rays);

  Sums run(Rung rung) const;
  std::uint64_t steps() const { return steps_.size(); }

 private:
  struct RecordedStep {
    std::int32_t hit;         ///< the daughter that is met, -1: the volume's own surface
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
  std::vector<std::int32_t> moves_;  ///< after a step: a daughter to enter, or -1: a level out
};

}  // namespace navjit::bench
