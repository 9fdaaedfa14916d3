// One run of the experiment, in this process, and its record as text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/options/detector.hpp"
#include "apps/warmup/blocks.hpp"
#include "apps/warmup/series.hpp"
#include "common/rays.hpp"
#include "navjit/options.hpp"

namespace navjit::warmup {

struct RunSetup {
  apps::Detector detector;
  common::RaySource source;
  unsigned threads = 1;
  double seconds = 5;        ///< how long rays are transported
  double interval = 0.02;    ///< between points of the series, s
  std::string save_profile;  ///< file for `navjit specialise`; empty: none
  RuntimeOptions runtime;
};

struct RunRecord {
  Series series;  ///< begins with the making of the Runtime: plugins and lists of hot scenes count
  std::vector<Swap> swaps;  ///< of scenes that are specialised in the end
  std::uint64_t rays = 0, steps = 0, stuck = 0;
  double navigating_s = 0;  ///< processor time of the navigating threads
  double other_s = 0;       ///< and of all others: profile, compiler, verification
  std::size_t modules = 0, cached_modules = 0, deoptimised = 0, code_bytes = 0;
  std::vector<Block> blocks;  ///< of the rays, from the first one on; a run is compared by them
};

/// Reads the detector, then transports rays for the given time. Throws what reading throws.
RunRecord run_once(const RunSetup& setup);

std::string to_text(const RunRecord& record);
/// Throws Error for what to_text has not made, and for series that go back.
RunRecord from_text(const std::string& text);

}  // namespace navjit::warmup
