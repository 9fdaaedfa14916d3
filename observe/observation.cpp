#include "navjit/observation.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include "navjit/errors.hpp"

namespace navjit {

namespace {

constexpr std::string_view budget = "budget:", mixtures = "mixtures:", from = "from=", eta = "eta=";
constexpr std::string_view percent = "%", grams = "g/cm2";

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

/// Numbers separated by slashes. Throws unless there are exactly `count`.
std::vector<double> numbers(std::string_view text, std::size_t count, const char* what) {
  std::vector<double> values;
  for (std::string_view rest = text;;) {
    const std::size_t end = rest.find('/');
    const auto value = number(rest.substr(0, end));
    if (!value) break;
    values.push_back(*value);
    if (end == std::string_view::npos) {
      if (values.size() == count) return values;
      break;
    }
    rest.remove_prefix(end + 1);
  }
  throw UsageError("'" + std::string(text) + "' is not " + what);
}

/// E, E% or Eg/cm2.
void read_budget(std::string_view text, Observation& observation) {
  std::string_view rest = text;
  double factor = 1;
  if (rest.ends_with(percent)) {
    rest.remove_suffix(percent.size());
    observation.unit = Observation::Unit::relative;
    factor = 0.01;
  } else if (rest.ends_with(grams)) {
    rest.remove_suffix(grams.size());
    observation.unit = Observation::Unit::grams_per_cm2;
  }
  const auto value = number(rest);
  if (!value || !(*value > 0)) {
    throw UsageError("'" + std::string(text) +
                     "' is no budget; give a positive number of radiation lengths, or one followed "
                     "by g/cm2 or %");
  }
  observation.budget = factor * *value;
}

/// E, then :from=X/Y/Z and :eta=LO/HI.
void read_mixtures(std::string_view text, Observation& observation) {
  std::size_t end = text.find(':');
  read_budget(text.substr(0, end), observation);
  while (end != std::string_view::npos) {
    text.remove_prefix(end + 1);
    end = text.find(':');
    const std::string_view part = text.substr(0, end);
    if (part.starts_with(from)) {
      const auto p = numbers(part.substr(from.size()), 3, "a point; give X/Y/Z in mm");
      observation.rays.origin = {p[0], p[1], p[2]};
    } else if (part.starts_with(eta)) {
      const auto p = numbers(part.substr(eta.size()), 2, "a range of pseudorapidity; give LO/HI");
      observation.rays.eta = {p[0], p[1]};
    } else {
      throw UsageError("'" + std::string(part) +
                       "' says nothing of rays; use from=X/Y/Z or eta=LO/HI");
    }
  }
  if (observation.rays.eta && !observation.rays.origin) observation.rays.origin = {0, 0, 0};
}

std::string text_of(double value) {
  // This text is read again, so it must not depend on the program's locale.
  char text[32];
  const auto written =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9);
  return {text, written.ptr};
}

std::string budget_text(const Observation& o) {
  switch (o.unit) {
    case Observation::Unit::radiation_lengths:
      break;
    case Observation::Unit::grams_per_cm2:
      return text_of(o.budget) + std::string(grams);
    case Observation::Unit::relative:
      return text_of(100 * o.budget) + std::string(percent);
  }
  return text_of(o.budget);
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
    read_budget(kind.substr(budget.size()), observation);
  } else if (kind.starts_with(mixtures)) {
    observation.kind = Observation::Kind::mixtures;
    read_mixtures(kind.substr(mixtures.size()), observation);
  } else {
    throw UsageError(
        "'" + std::string(text) +
        "' is nothing to observe; use all, materials[,VOLUME...], budget:E[,VOLUME...] or "
        "mixtures:E[,VOLUME...]");
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
  std::string text = "all";
  switch (observation.kind) {
    case Observation::Kind::all:
      break;
    case Observation::Kind::materials:
      text = "materials";
      break;
    case Observation::Kind::budget:
      text = std::string(budget) + budget_text(observation);
      break;
    case Observation::Kind::mixtures: {
      text = std::string(mixtures) + budget_text(observation);
      const auto& [origin, range] = observation.rays;
      if (origin) {
        text += ':' + std::string(from) + text_of(origin->x) + '/' + text_of(origin->y) + '/' +
                text_of(origin->z);
      }
      if (range) {
        text += ':' + std::string(eta) + text_of(range->first) + '/' + text_of(range->second);
      }
      break;
    }
  }
  for (const std::string& name : observation.volumes) text += ',' + name;
  return text;
}

}  // namespace navjit
