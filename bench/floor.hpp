// The least that a ray's answers cost: its steps are repeated with every choice known beforehand.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "runtime/transport.hpp"

namespace navjit::bench {

/// Recorded steps of rays whose boundaries are all known: which surface ends each step, and in
/// which frame.
class Floor {
 public:
  Floor(const Geometry& geometry, const std::vector<Ray>& rays);

  /// Repeats the steps and does nothing else: moves the point into the frame of the solid whose
  /// surface ends the step, computes one distance, and the next point. Each step begins where the
  /// one before ended. Returns the total length, mm.
  double run() const;

  std::uint64_t steps() const { return steps_.size(); }

 private:
  struct RecordedStep {
    double translation[3];
    const double* rotation;  ///< null: no rotation
    const Direction* direction;
    kernels::AnySolid<double> solid;
    bool out;
    std::uint32_t volume;
  };
  struct Start {
    Ray ray;
    std::size_t end;  ///< in steps_
  };

  double tolerance_;
  std::vector<Start> starts_;
  std::vector<RecordedStep> steps_;
  std::deque<std::array<double, 9>> rotations_;
  std::deque<Direction> directions_;
};

}  // namespace navjit::bench
