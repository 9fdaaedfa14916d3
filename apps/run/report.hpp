// What `navjit run` tells at its end: a table for people, JSON for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/run/compare.hpp"
#include "apps/run/transport.hpp"
#include "common/part.hpp"
#include "navjit/observation.hpp"
#include "navjit/options.hpp"
#include "navjit/report.hpp"

namespace navjit::apps {

struct RunReport {
  std::string detector;
  const ObservedDetector* seen = nullptr;
  Transport transport;
  std::size_t basket = 0;  ///< rays at once; 0: one by one
  common::Part part{};
  std::string rays_of{};   ///< of which rays that is a part
  unsigned processes = 1;  ///< that shared the rays
  bool interrupted = false;
  double compile_cpu_seconds = 0;  ///< processor time of all but the navigating threads
  JitMode jit = JitMode::on;
  std::optional<double> budget{};  ///< asked for, mm
  std::optional<Comparison> compared{};
  RuntimeReport runtime;

  /// Whether a scene is navigated by other than the generic navigator.
  bool any_specialised() const;
  /// Of the comparison; 1 where nothing was specialised, so that there is nothing to compare.
  /// Nothing where it is not known.
  std::optional<double> speedup() const;
};

void print_table(const RunReport& report);
std::string json_text(const RunReport& report);

}  // namespace navjit::apps
