// The scenes that earlier runs of a detector found hot and compiled together. The list is kept in
// the cache, so that the next run need not wait for its own profile, and asks for the same modules.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/scene_plan.hpp"

namespace navjit {

struct ListedScene {
  VolumeId volume = 0;
  /// The search that its code uses, if a run measured that another one is faster than the one that
  /// the analysis chooses.
  std::optional<Candidates> search{};

  bool operator==(const ListedScene&) const = default;
};

/// A batch of scenes, as they were compiled.
struct ListedModule {
  std::vector<ListedScene> scenes{};
  /// Scenes that are not in the batch, but had a measured search when it was compiled: the text of
  /// a module contains the searches of the mothers and daughters of its scenes, too.
  std::vector<ListedScene> beside{};

  bool operator==(const ListedModule&) const = default;
};
using ModuleList = std::vector<ListedModule>;

/// The measured searches that code can use.
constexpr bool may_be_listed(Candidates search) { return facts_of(search).listed_if_faster; }

std::string write_module_list(const ModuleList& list);

/// The list in the text; nothing if the text is not a list of modules for `volumes` volumes. Every
/// number is checked, and none may occur twice in a module. A scene is in several batches if it was
/// compiled again, with others or alone. More occurrences than a run can make are refused.
std::optional<ModuleList> read_module_list(std::string_view text, std::size_t volumes);

/// `mine`, and the modules of `others` that share no scene with it.
ModuleList merge(const ModuleList& mine, const ModuleList& others);

}  // namespace navjit
