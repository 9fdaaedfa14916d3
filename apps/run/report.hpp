// What `navjit run` tells at its end: a table for people, JSON for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/options.hpp"
#include "runtime/report.hpp"

namespace navjit::apps {

struct RunReport {
  std::string detector;
  std::uint64_t rays = 0, steps = 0, stuck = 0;
  double length_mm = 0;
  double seconds = 0;
  double steps_per_second = 0;       ///< whole run
  double warm_steps_per_second = 0;  ///< after the last swap
  unsigned threads = 1;
  JitMode jit = JitMode::on;
  Level level = Level::exact;      ///< asked for
  std::optional<double> budget{};  ///< asked for, mm
  std::uint64_t declined = 0, differences = 0;
  /// The first rays again, in turn with and without specialised navigators, one thread; 0: not
  /// made.
  std::uint64_t compared_rays = 0;
  double compared_with = 0, compared_without = 0;  ///< steps per second
  RuntimeReport runtime;
};

void print_table(const RunReport& report);
std::string json_text(const RunReport& report);

}  // namespace navjit::apps
