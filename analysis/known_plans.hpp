// Plans that were made before. The plan of a hall of thousands of daughters takes a tenth of a
// second, and is needed several times: when the scene is bound to data, when it is chosen for
// compiling, when its code is written, and when that of a scene beside it is.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>

#include "analysis/scene_plan.hpp"

namespace navjit {

/// The plans of one world. Thread-safe.
class KnownPlans {
 public:
  /// All that a plan depends on besides the world.
  struct Question {
    VolumeId volume;
    std::optional<Candidates> forced;
    bool along_faces, with_safety;

    auto operator<=>(const Question&) const = default;
  };

  /// The plan; null if it was not made before.
  std::shared_ptr<const ScenePlan> find(const Question& question) const {
    const std::lock_guard lock(mutex_);
    const auto known = plans_.find(question);
    return known == plans_.end() ? nullptr : known->second;
  }

  void keep(const Question& question, const ScenePlan& plan) {
    auto kept = std::make_shared<const ScenePlan>(plan);
    const std::lock_guard lock(mutex_);
    plans_.emplace(question, std::move(kept));
  }

 private:
  mutable std::mutex mutex_;
  std::map<Question, std::shared_ptr<const ScenePlan>> plans_;
};

}  // namespace navjit
