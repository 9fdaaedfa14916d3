// A run's record as JSON: how a run in a process of its own tells the experiment.
#include <cmath>
#include <nlohmann/json.hpp>

#include "navjit/errors.hpp"

#include "apps/warmup/one_run.hpp"

namespace navjit::warmup {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const char* what) {
  throw Error(std::string("its record is not usable: ") + what);
}

double amount(const Json& json) {
  const double value = json.get<double>();
  if (!std::isfinite(value) || value < 0) fail("a number is negative, or none");
  return value;
}

}  // namespace

std::string to_text(const RunRecord& record) {
  Json json{{"rays", record.rays},
            {"steps", record.steps},
            {"stuck", record.stuck},
            {"navigating_s", record.navigating_s},
            {"other_s", record.other_s},
            {"modules", record.modules},
            {"cached_modules", record.cached_modules},
            {"deoptimised", record.deoptimised},
            {"code_bytes", record.code_bytes}};
  for (const char* list : {"series", "swaps", "blocks"}) json[list] = Json::array();
  for (const Point& p : record.series)
    json["series"].push_back({p.seconds, p.steps, p.processor_s});
  for (const Swap& s : record.swaps) json["swaps"].push_back({s.seconds, s.share});
  for (const Block& b : record.blocks) json["blocks"].push_back({b.steps, b.lengths});
  return json.dump();
}

RunRecord from_text(const std::string& text) try {
  const Json json = Json::parse(text);
  RunRecord record;
  json.at("rays").get_to(record.rays);
  json.at("steps").get_to(record.steps);
  json.at("stuck").get_to(record.stuck);
  record.navigating_s = amount(json.at("navigating_s"));
  record.other_s = amount(json.at("other_s"));
  json.at("modules").get_to(record.modules);
  json.at("cached_modules").get_to(record.cached_modules);
  json.at("deoptimised").get_to(record.deoptimised);
  json.at("code_bytes").get_to(record.code_bytes);
  for (const Json& p : json.at("series")) {
    const Point next{amount(p.at(0)), amount(p.at(1)), amount(p.at(2))};
    const Point last = record.series.empty() ? Point{-1} : record.series.back();
    if (next.seconds <= last.seconds || next.steps < last.steps ||
        next.processor_s < last.processor_s) {
      fail("its series goes back");
    }
    record.series.push_back(next);
  }
  for (const Json& s : json.at("swaps")) {
    record.swaps.push_back({amount(s.at(0)), amount(s.at(1))});
  }
  for (const Json& b : json.at("blocks")) {
    record.blocks.push_back({b.at(0).get<std::uint64_t>(), b.at(1).get<std::uint64_t>()});
  }
  return record;
} catch (const nlohmann::json::exception& error) {
  fail(error.what());
}

}  // namespace navjit::warmup
