#include "runtime/module_list.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

namespace navjit {
namespace {

constexpr std::string_view first_line = "navjit hot scenes 3\n";

/// A scene is compiled again when it is sixteen times as hot as before, or when its code left out
/// too many steps.
constexpr unsigned most_modules_of_a_scene = 16;

/// ":scan": what follows the number of a scene.
std::string suffix(const SearchFacts& facts) { return ":" + std::string(facts.name); }

/// Takes "12" or "12:scan" from the front of the text.
std::optional<ListedScene> take_scene(std::string_view& text) {
  ListedScene scene;
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), scene.volume);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(at - text.data()));
  for (const SearchFacts& facts : all_searches) {
    if (scene.search || !facts.listed_if_faster || !text.starts_with(suffix(facts))) continue;
    scene.search = facts.search;
    text.remove_prefix(suffix(facts).size());
  }
  return scene;
}

}  // namespace

std::string write_module_list(const ModuleList& list) {
  std::string text(first_line);
  const auto write = [&](const ListedScene& scene) {
    text += std::to_string(scene.volume);
    if (scene.search && may_be_listed(*scene.search)) text += suffix(facts_of(*scene.search));
  };
  for (const ListedModule& module : list) {
    for (std::size_t i = 0; i < module.scenes.size(); ++i) {
      if (i > 0) text += ' ';
      write(module.scenes[i]);
    }
    for (std::size_t i = 0; i < module.beside.size(); ++i) {
      text += i == 0 ? '|' : ' ';
      write(module.beside[i]);
    }
    text += '\n';
  }
  return text;
}

std::optional<ModuleList> read_module_list(std::string_view text, std::size_t volumes) {
  if (text.substr(0, first_line.size()) != first_line) return std::nullopt;
  text.remove_prefix(first_line.size());
  ModuleList list;
  std::map<VolumeId, unsigned> modules_of;
  while (!text.empty()) {
    ListedModule& module = list.emplace_back();
    std::set<VolumeId> seen;
    bool beside = false;
    for (char end = ' '; end != '\n';) {
      const std::optional<ListedScene> scene = take_scene(text);
      if (!scene || scene->volume >= volumes || !seen.insert(scene->volume).second ||
          (beside ? !scene->search : ++modules_of[scene->volume] > most_modules_of_a_scene) ||
          text.empty()) {
        return std::nullopt;
      }
      (beside ? module.beside : module.scenes).push_back(*scene);
      end = text[0];
      if (end != ' ' && end != '\n' && (end != '|' || beside)) return std::nullopt;
      beside = beside || end == '|';
      text.remove_prefix(1);
    }
  }
  return list;
}

ModuleList merge(const ModuleList& mine, const ModuleList& others) {
  ModuleList merged = mine;
  std::set<VolumeId> taken;
  for (const ListedModule& module : mine) {
    for (const ListedScene& scene : module.scenes) taken.insert(scene.volume);
  }
  for (const ListedModule& module : others) {
    if (std::none_of(module.scenes.begin(), module.scenes.end(),
                     [&](const ListedScene& s) { return taken.contains(s.volume); })) {
      merged.push_back(module);
    }
  }
  return merged;
}

}  // namespace navjit
