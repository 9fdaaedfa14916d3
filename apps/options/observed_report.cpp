#include "apps/options/observed_report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace navjit::apps {

namespace {

const char* per_ray(Observation::Unit unit) {
  return unit == Observation::Unit::grams_per_cm2 ? "g/cm2" : "radiation lengths";
}

const char* key_of_bound(const Observation& o) {
  if (o.unit == Observation::Unit::grams_per_cm2) return "bound_g_per_cm2";
  const bool relative = o.unit == Observation::Unit::relative;
  return relative && o.kind == Observation::Kind::budget ? "bound_relative"
                                                         : "bound_radiation_lengths";
}

nlohmann::ordered_json mixtures_json(const ObservationReport& r, const char* bound) {
  auto list = nlohmann::ordered_json::array();
  for (const ObservationReport::Mixture& m : r.mixtures) {
    list.push_back({{"volume", m.volume},
                    {"of", m.of},
                    {"placements", m.placements},
                    {"material", m.material},
                    {"density_g_per_cm3", m.density},
                    {"radiation_length_mm", m.radiation_length},
                    {bound, m.bound}});
  }
  return list;
}

}  // namespace

std::string bound_text(const Observation& o, double bound) {
  char text[64];
  if (o.kind == Observation::Kind::budget && o.unit == Observation::Unit::relative) {
    std::snprintf(text, sizeof text, "%.3g%%", 100 * bound);
  } else {
    std::snprintf(text, sizeof text, "%.3g %s", bound, per_ray(o.unit));
  }
  return text;
}

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
  const Observation& o = seen.observation();
  if (o.kind == Observation::Kind::mixtures) {
    const ObservationReport::Measured& m = r.measured;
    std::printf(
        "%zu volume%s homogenised. Measured on %llu %s rays, %.4g %s each in the mean: the mean "
        "change of a ray is %.3g, 99%% change by at most %.3g, 99.9%% by %.3g, all by %.3g\n",
        r.mixtures.size(), r.mixtures.size() == 1 ? " is" : "s are",
        static_cast<unsigned long long>(m.rays), o.rays.origin ? "other" : "other isotropic",
        m.whole, per_ray(o.unit), m.mean, m.of_99_percent, m.of_999_permille, m.largest);
  }
  if (r.bound > 0) std::printf("no ray changes by more than %s\n", bound_text(o, r.bound).c_str());
}

nlohmann::ordered_json to_json(const ObservedDetector& seen) {
  const ObservationReport& r = seen.report();
  const char* const bound = key_of_bound(seen.observation());
  const auto entries = [&](const std::vector<ObservationReport::Entry>& all, bool with_reason) {
    auto list = nlohmann::ordered_json::array();
    for (const ObservationReport::Entry& e : all) {
      list.push_back({{"volume", e.volume}, {"mother", e.mother}, {"placements", e.placements}});
      if (e.bound > 0) list.back()[bound] = e.bound;
      if (with_reason) list.back()["why"] = e.why;
    }
    return list;
  };
  nlohmann::ordered_json json{{"kind", observation_text(seen.observation())},
                              {"invisible", r.invisible},
                              {"dissolved", r.dissolved},
                              {"sampled", r.sampled},
                              {bound, r.bound},
                              {"placements_before", r.placements_before},
                              {"placements_after", r.placements_after},
                              {"touchables_before", r.touchables_before},
                              {"touchables_after", r.touchables_after},
                              {"gone", entries(r.gone, false)},
                              {"left", entries(r.left, true)}};
  if (seen.observation().kind == Observation::Kind::mixtures) {
    const ObservationReport::Measured& m = r.measured;
    json["mixtures"] = mixtures_json(r, bound);
    json["measured"] = {{"unit", per_ray(seen.observation().unit)},
                        {"rays", m.rays},
                        {"mean_of_ray", m.whole},
                        {"mean_change", m.mean},
                        {"mean_change_error", m.mean_error},
                        {"signed_mean_change", m.signed_mean},
                        {"signed_mean_change_error", m.signed_error},
                        {"change_99_percent", m.of_99_percent},
                        {"change_99.9_percent", m.of_999_permille},
                        {"largest_change", m.largest}};
  }
  return json;
}

}  // namespace navjit::apps
