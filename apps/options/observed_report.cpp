#include "apps/options/observed_report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace navjit::apps {

void print_observation(const ObservedDetector& seen) {
  if (seen.observation().kind == Observation::Kind::all) return;
  const ObservationReport& r = seen.report();
  std::printf(
      "observed %s: of %llu placements %llu are %s and nobody's; "
      "%llu of these are dissolved (%llu on the word of samples)\n",
      observation_text(seen.observation()).c_str(),
      static_cast<unsigned long long>(r.placements_before),
      static_cast<unsigned long long>(r.invisible),
      seen.observation().kind == Observation::Kind::budget ? "within the budget"
                                                           : "in their own material",
      static_cast<unsigned long long>(r.dissolved), static_cast<unsigned long long>(r.sampled));
  if (r.bound > 0) {
    std::printf("no ray changes by more than %.3g radiation lengths\n", r.bound);
  }
}

nlohmann::ordered_json to_json(const ObservedDetector& seen) {
  const ObservationReport& r = seen.report();
  const auto entries = [](const std::vector<ObservationReport::Entry>& all, bool with_reason) {
    auto list = nlohmann::ordered_json::array();
    for (const ObservationReport::Entry& e : all) {
      list.push_back({{"volume", e.volume}, {"mother", e.mother}, {"placements", e.placements}});
      if (e.bound > 0) list.back()["bound_radiation_lengths"] = e.bound;
      if (with_reason) list.back()["why"] = e.why;
    }
    return list;
  };
  return {{"kind", observation_text(seen.observation())},
          {"invisible", r.invisible},
          {"dissolved", r.dissolved},
          {"sampled", r.sampled},
          {"bound_radiation_lengths", r.bound},
          {"placements_before", r.placements_before},
          {"placements_after", r.placements_after},
          {"touchables_before", r.touchables_before},
          {"touchables_after", r.touchables_after},
          {"gone", entries(r.gone, false)},
          {"left", entries(r.left, true)}};
}

}  // namespace navjit::apps
