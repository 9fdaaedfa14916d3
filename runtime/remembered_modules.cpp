#include "runtime/remembered_modules.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "runtime/choose.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/install.hpp"
#include "runtime/make_module.hpp"
#include "runtime/measured_search.hpp"

namespace navjit {
namespace {

std::vector<VolumeId> volumes_of(const std::vector<ListedScene>& scenes) {
  std::vector<VolumeId> volumes;
  for (const ListedScene& scene : scenes) volumes.push_back(scene.volume);
  return volumes;
}

/// What the cache has of earlier runs of this detector.
std::optional<ModuleList> recall(Specialisation& spec) {
  const std::optional<std::string> text = spec.maker->recall(spec.module_list_name);
  if (!text) return std::nullopt;
  std::optional<ModuleList> list = read_module_list(*text, spec.shared->geometry.size());
  if (!list) {
    spec.shared->log->info(
        "the cache's list of this detector's hot scenes is none that this version reads: the run "
        "begins without it, and writes its own");
  }
  return list;
}

}  // namespace

void install_remembered(Specialisation& spec) {
  if (!spec.maker->has_cache()) return;
  const Geometry& geometry = spec.shared->geometry;
  spec.module_list_name = "hot scenes of " + geometry_fingerprint(geometry);
  const std::optional<ModuleList> list = recall(spec);
  if (!list) return;
  // Each module has the searches that it was compiled with. They stay for the scenes of modules
  // that are installed.
  const std::map<VolumeId, Candidates> before = spec.facts.forced_candidates;
  std::map<VolumeId, Candidates> after = before;
  for (const ListedModule& listed : *list) {
    const std::vector<VolumeId> batch = volumes_of(listed.scenes);
    {
      const std::lock_guard lock(spec.mutex);
      const bool fresh = std::all_of(batch.begin(), batch.end(), [&](VolumeId v) {
        return spec.facts.reachable[v] && spec.facts.first_equal[v] == v &&
               !spec.scenes.contains(v);
      });
      if (spec.stopping()) return;
      if (!fresh) continue;
    }
    spec.facts.forced_candidates = before;
    for (const ListedScene& scene : listed.scenes) search_as_listed(spec, scene);
    for (const ListedScene& scene : listed.beside) search_as_listed(spec, scene);
    // Modules whose code the cache does not have any more are left to the profile of this run.
    using codegen::Leaves;
    for (const auto& [along_faces, leaves] :
         {std::pair(false, Leaves::apart), std::pair(false, Leaves::shared),
          std::pair(true, Leaves::apart), std::pair(true, Leaves::shared)}) {
      const double start = steady_seconds();
      const codegen::Module module = generate(spec, batch, along_faces, leaves);
      auto found = spec.maker->find(module.source);
      if (!found) continue;
      if (install(spec, module, std::move(found->code), true, start)) {
        spec.module_list.push_back(listed);
        for (const VolumeId volume : batch) {
          const VolumeId first = spec.facts.first_equal[volume];
          const auto measured = spec.facts.forced_candidates.find(first);
          if (measured != spec.facts.forced_candidates.end()) after[first] = measured->second;
        }
      } else if (!spec.stopping()) {
        spec.maker->reject(module.source);
      }
      break;
    }
  }
  spec.facts.forced_candidates = std::move(after);
}

namespace {

void remember(Specialisation& spec, ListedModule listed) {
  if (!spec.maker->has_cache() || spec.shared->options.jit == JitMode::wait) return;
  ModuleList& list = spec.module_list;
  if (std::find(list.begin(), list.end(), listed) == list.end()) list.push_back(std::move(listed));
  // Other runs of the same detector may meanwhile have found other scenes.
  const std::optional<ModuleList> others = recall(spec);
  const ModuleList merged = others ? merge(spec.module_list, *others) : spec.module_list;
  if (others && *others == merged) return;
  spec.maker->remember(spec.module_list_name, "which scenes are hot in a detector",
                       write_module_list(merged));
}

}  // namespace

void make_and_remember(Specialisation& spec, const std::vector<VolumeId>& batch) {
  const std::vector<VolumeId> worth = worth_trying(spec, batch);
  if (worth.empty()) return;
  for (ListedModule& made : make_modules(spec, worth)) remember(spec, std::move(made));
}

}  // namespace navjit
