#include "apps/options/observed_report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace navjit::apps {

void print_observation(const ObservedDetector& seen) {
  if (seen.observation().kind == Observation::Kind::all) return;
  const ObservationReport& r = seen.report();
  std::printf(
      "observed %s: of %llu placements %llu are in their own material and nobody's; "
      "%llu of these are dissolved (%llu on the word of samples)\n",
      observation_text(seen.observation()).c_str(),
      static_cast<unsigned long long>(r.placements_before),
      static_cast<unsigned long long>(r.invisible), static_cast<unsigned long long>(r.dissolved),
      static_cast<unsigned long long>(r.sampled));
}

nlohmann::ordered_json to_json(const ObservedDetector& seen) {
  const ObservationReport& r = seen.report();
  const auto entries = [](const std::vector<ObservationReport::Entry>& all, bool with_reason) {
    auto list = nlohmann::ordered_json::array();
    for (const ObservationReport::Entry& e : all) {
      list.push_back({{"volume", e.volume}, {"mother", e.mother}, {"placements", e.placements}});
      if (with_reason) list.back()["why"] = e.why;
    }
    return list;
  };
  return {{"kind", observation_text(seen.observation())},
          {"invisible", r.invisible},
          {"dissolved", r.dissolved},
          {"sampled", r.sampled},
          {"placements_before", r.placements_before},
          {"placements_after", r.placements_after},
          {"touchables_before", r.touchables_before},
          {"touchables_after", r.touchables_after},
          {"gone", entries(r.gone, false)},
          {"left", entries(r.left, true)}};
}

}  // namespace navjit::apps
