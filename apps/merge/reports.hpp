// Reports of runs that were made side by side, as one (docs/report.md).
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace navjit::apps {

/// Adds reports up. Throws Error for what is no report of a run, one of another detector or other
/// options, and a part that is there twice.
class ReportMerger {
 public:
  void add(const nlohmann::json& report);
  /// One report of all that were added; there has to be at least one.
  nlohmann::ordered_json merged() const;
  /// "; parts 3 and 4 of 100 are missing" or nothing, for people.
  std::string missing() const;

 private:
  struct Scene {
    std::uint64_t steps = 0, most_steps = 0, relocations = 0;
    double generic_ns = 0, generic_steps = 0;          ///< sum of ns by steps, and those steps
    double specialised_ns = 0, specialised_steps = 0;  ///< likewise
    double compile_ms = 0, specialised_at_s = 0, swapped_at_s = 0;
    bool always_specialised = true;
    nlohmann::json of_most_steps{};  ///< binding, status, note, code are those of this report
  };
  void add_part(const nlohmann::json& report);
  void add_scenes(const nlohmann::json& report);
  void add_comparison(const nlohmann::json& report);
  double scenes_steps() const;

  std::vector<nlohmann::json> reports_;
  std::map<std::pair<std::string, std::string>, Scene> scenes_;  ///< by volume and structure
  std::uint64_t compared_ = 0;                                   ///< reports that have a comparison
  std::uint64_t compared_rays_ = 0;
  double with_ = 0, without_ = 0;  ///< steps per second of it
  std::set<std::uint64_t> parts_;
  std::string rays_of_;   ///< of which rays the first report is a part
  std::uint64_t of_ = 0;  ///< parts that there are in all; 0: runs that are no parts
};

}  // namespace navjit::apps
