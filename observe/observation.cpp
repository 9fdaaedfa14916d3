#include "navjit/observation.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "navjit/errors.hpp"

namespace navjit {

namespace {

constexpr std::string_view budget = "budget:";

double read_budget(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value > 0) ||
      !std::isfinite(value)) {
    throw UsageError("'" + std::string(text) +
                     "' is no budget; give a positive number of radiation lengths");
  }
  return value;
}

}  // namespace

Observation parse_observation(std::string_view text) {
  Observation observation;
  const std::size_t comma = text.find(',');
  const std::string_view kind = text.substr(0, comma);
  if (kind == "all") {
    observation.kind = Observation::Kind::all;
  } else if (kind == "materials") {
    observation.kind = Observation::Kind::materials;
  } else if (kind.starts_with(budget)) {
    observation.kind = Observation::Kind::budget;
    observation.budget = read_budget(kind.substr(budget.size()));
  } else {
    throw UsageError(
        "'" + std::string(text) +
        "' is nothing to observe; use all, materials[,VOLUME...] or budget:E[,VOLUME...]");
  }
  if (comma == std::string_view::npos) return observation;
  if (observation.kind == Observation::Kind::all) {
    throw UsageError("with all, every volume is observed: name none");
  }
  for (std::string_view rest = text.substr(comma + 1);;) {
    const std::size_t end = rest.find(',');
    const std::string_view name = rest.substr(0, end);
    if (name.empty()) throw UsageError("a volume without a name is to be observed");
    observation.volumes.emplace_back(name);
    if (end == std::string_view::npos) return observation;
    rest.remove_prefix(end + 1);
  }
}

std::string observation_text(const Observation& observation) {
  std::string text = observation.kind == Observation::Kind::all ? "all" : "materials";
  if (observation.kind == Observation::Kind::budget) {
    char number[32];
    std::snprintf(number, sizeof number, "%g", observation.budget);
    text = std::string(budget) + number;
  }
  for (const std::string& name : observation.volumes) text += ',' + name;
  return text;
}

}  // namespace navjit
