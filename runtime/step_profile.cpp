#include "navjit/step_profile.hpp"

#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "files/output_file.hpp"
#include "geometry/input_file.hpp"

namespace navjit {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "navjit profile";
constexpr std::uint64_t version = 1;
constexpr std::size_t max_bytes = std::size_t{64} << 20;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw Error(path + ": " + why);
}

std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  return a > most - b ? most : a + b;
}

/// The value of `key` in an object, which must be a whole number of at most `most`.
std::uint64_t whole_number(const std::string& path, const Json& object, const char* key,
                           std::uint64_t most) {
  const auto at = object.find(key);
  if (at == object.end() || !at->is_number_unsigned() || at->get<std::uint64_t>() > most) {
    fail(path, std::string("'") + key + "' is not a whole number, or too large");
  }
  return at->get<std::uint64_t>();
}

const std::string& text(const std::string& path, const Json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end() || !at->is_string()) {
    fail(path, std::string("'") + key + "' is not a text");
  }
  return at->get_ref<const std::string&>();
}

std::string bytes_of(const std::string& path) {
  Expected<std::string> bytes =
      read_regular_file(path, max_bytes, "longer than " + std::to_string(max_bytes) + " bytes");
  if (!bytes) fail(path, bytes.failure().message);
  return *std::move(bytes);
}

}  // namespace

std::string profile_text(const StepProfile& profile) {
  Json json{{"format", format},
            {"version", version},
            {"geometry", profile.geometry},
            {"runs", profile.runs}};
  auto& volumes = json["volumes"] = Json::array();
  for (const StepProfile::Volume& v : profile.volumes) {
    volumes.push_back({{"volume", v.volume},
                       {"name", v.name},
                       {"steps", v.steps},
                       {"relocations", v.relocations}});
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_profile(const StepProfile& profile, const std::string& path) {
  write_output(path, profile_text(profile));
}

StepProfile read_profile(const std::string& path) { return parse_profile(bytes_of(path), path); }

StepProfile parse_profile(const std::string& bytes, const std::string& path) {
  const Json json = Json::parse(bytes, nullptr, false);
  if (!json.is_object() || text(path, json, "format") != format) {
    fail(path, "it is no profile of navjit");
  }
  if (whole_number(path, json, "version", ~std::uint64_t{0}) != version) {
    fail(path, "it is a profile of another version of navjit");
  }
  StepProfile profile;
  profile.geometry = text(path, json, "geometry");
  profile.runs = whole_number(path, json, "runs", ~std::uint64_t{0});
  const auto volumes = json.find("volumes");
  if (volumes == json.end() || !volumes->is_array()) fail(path, "'volumes' is not an array");
  for (const Json& row : *volumes) {
    if (!row.is_object()) fail(path, "a volume is not an object");
    StepProfile::Volume v;
    v.volume = static_cast<VolumeId>(
        whole_number(path, row, "volume", std::numeric_limits<VolumeId>::max()));
    v.name = text(path, row, "name");
    v.steps = whole_number(path, row, "steps", ~std::uint64_t{0});
    v.relocations = whole_number(path, row, "relocations", ~std::uint64_t{0});
    if (!profile.volumes.empty() && profile.volumes.back().volume >= v.volume) {
      fail(path, "volumes are not in the order of their numbers");
    }
    profile.volumes.push_back(std::move(v));
  }
  return profile;
}

StepProfile merge(const StepProfile& a, const StepProfile& b) {
  if (a.geometry != b.geometry) {
    throw Error("the profiles are of different detectors, or versions of one");
  }
  StepProfile merged;
  merged.geometry = a.geometry;
  merged.runs = sum(a.runs, b.runs);
  std::map<VolumeId, StepProfile::Volume> volumes;
  for (const StepProfile* part : {&a, &b}) {
    for (const StepProfile::Volume& v : part->volumes) {
      const auto [at, is_new] = volumes.try_emplace(v.volume, v);
      if (is_new) continue;
      at->second.steps = sum(at->second.steps, v.steps);
      at->second.relocations = sum(at->second.relocations, v.relocations);
    }
  }
  for (auto& [number, volume] : volumes) merged.volumes.push_back(std::move(volume));
  return merged;
}

}  // namespace navjit
