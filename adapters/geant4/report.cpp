// What a run asked of the navigator, and what it took.
#include <algorithm>
#include <ctime>
#include <iomanip>
#include <ostream>
#include <vector>

#include "navjit/geant4/use.hpp"

namespace navjit::geant4 {
namespace {

/// What the clock adds to what it measures, s: the median of many times nothing.
double clock_overhead() {
  std::vector<double> times(1001);
  for (double& time : times) {
    const double start = sampling_time();
    time = sampling_time() - start;
  }
  std::nth_element(times.begin(), times.begin() + 500, times.end());
  return times[500];
}

void print_calls(const Counts& counts, double seconds, std::ostream& out) {
  double sum = 0;
  const double clock = clock_overhead();
  for (std::size_t i = 0; i < call_kinds; ++i) {
    const CallCount& count = counts.calls[i];
    if (count.calls == 0) continue;
    const double seconds_of_calls = std::max(count.seconds(clock), 0.0);
    sum += seconds_of_calls;
    out << "  " << std::left << std::setw(30) << call_name(static_cast<Call>(i)) << std::right
        << std::setw(12) << count.calls << " calls " << std::setw(8) << std::fixed
        << std::setprecision(1) << 1e9 * seconds_of_calls / static_cast<double>(count.calls)
        << " ns each " << std::setw(9) << std::setprecision(3) << seconds_of_calls << " s\n";
  }
  out << "  navigation: " << std::setprecision(2) << sum << " s of " << seconds
      << " s of processor time";
  if (seconds > 0) out << " (" << std::setprecision(1) << 100 * sum / seconds << "%)";
  out << ", from one call in " << sampled_calls << "\n";
}

void print_differences(const Differences& d, std::ostream& out) {
  out << "  shadow: " << d.steps << " steps, " << d.lengths << " of other length (others agree to "
      << std::scientific << std::setprecision(1) << d.largest_length << " mm); "
      << std::defaultfloat << d.locates << " locates, " << d.histories << " elsewhere, " << d.ties
      << " on the other side of a face; " << d.safeties << " safeties too large; " << d.normals
      << " other normals\n";
}

void print_volumes(const RuntimeReport& report, std::ostream& out) {
  out << "  " << report.steps << " steps asked of navjit; " << report.modules
      << " modules compiled (" << report.cached_modules << " from the cache) in " << std::fixed
      << std::setprecision(2) << report.compile_ms / 1000 << " s\n";
  constexpr std::size_t shown = 8;
  for (std::size_t i = 0; i < std::min(shown, report.scenes.size()); ++i) {
    const SceneReport& scene = report.scenes[i];
    if (scene.steps == 0) break;
    out << "    " << std::setprecision(1) << std::setw(5) << 100 * scene.share << "%  "
        << scene.volume << '\n';
  }
}

void print_asked(const std::vector<std::string>& volumes, std::ostream& out) {
  if (volumes.empty()) return;
  constexpr std::size_t shown = 5;
  out << "  Geant4's own solids were asked in " << volumes.size()
      << (volumes.size() == 1 ? " volume:" : " volumes:");
  for (std::size_t i = 0; i < std::min(shown, volumes.size()); ++i) {
    out << (i == 0 ? " " : ", ") << volumes[i];
  }
  out << (volumes.size() > shown ? ", ...\n" : "\n");
}

}  // namespace

void print_report(Session& session, std::ostream& out) {
  const Counts counts = session.counts();
  const auto flags = out.flags();
  const auto precision = out.precision();
  out << "navjit in Geant4";
  if (session.options().mode == Mode::geant4) out << " (Geant4's own navigator)";
  if (!session.refusal().empty()) out << " (refused: " << session.refusal() << ')';
  out << '\n';
  print_calls(counts, session.processor_seconds(), out);
  if (counts.zero_steps > 0) {
    out << "  " << counts.zero_steps << " steps did not move; " << counts.pushed
        << " tracks were pushed, " << counts.abandoned << " abandoned\n";
  }
  if (session.options().mode == Mode::shadow) print_differences(counts.differences, out);
  if (const auto engine = session.present_engine()) {
    print_volumes(engine->runtime.report(), out);
    print_asked(engine->geometry.asked_of_geant4(), out);
  }
  out.flags(flags);
  out.precision(precision);
}

}  // namespace navjit::geant4
