// The whole experiment: engines side by side on the same rays, each step held against the
// reference.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/accuracy/figures.hpp"
#include "apps/accuracy/peer.hpp"
#include "apps/accuracy/track.hpp"
#include "navjit/options.hpp"

namespace navjit::accuracy {

struct ExperimentOptions {
  std::vector<Ray> rays;
  std::uint64_t seed = 1;  ///< of the long track
  unsigned threads = 1;
  int repetitions = 5;                ///< of the timing
  std::uint64_t boundaries = 100000;  ///< of the long track; 0: none
  GeometryOptions geometry;
  std::optional<VecGeom::Options> vecgeom;  ///< nothing: without it
  /// Called once all is compiled: from then on there may be something to tell.
  std::function<void()> prepared{};
};

struct EngineReport {
  std::string name;
  std::string failure;  ///< why there are no figures, or not all; empty: all is well
  EngineFigures figures;
  double ns_per_step = 0;               ///< whole rays, median of repetitions; 0: not measured
  std::map<VolumeId, double> scene_ns;  ///< ns a step by the volume it is made in; processor time
  TrackResult track;
};

struct ExperimentReport {
  std::vector<EngineReport> engines;  ///< the generic navigator first
  double seconds = 0;
  bool interrupted = false;  ///< by a signal: holds for what was done before it
};

/// Throws common::Interrupted if a signal comes before any ray is judged.
ExperimentReport run_experiment(const std::shared_ptr<const World>& world,
                                const ExperimentOptions& options);

}  // namespace navjit::accuracy
