#include "runtime/module_list.hpp"

#include <algorithm>
#include <charconv>
#include <set>

namespace navjit {
namespace {

constexpr std::string_view first_line = "navjit hot scenes 1\n";

}  // namespace

std::string write_module_list(const ModuleList& list) {
  std::string text(first_line);
  for (const auto& batch : list) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      text += (i == 0 ? "" : " ") + std::to_string(batch[i]);
    }
    text += '\n';
  }
  return text;
}

std::optional<ModuleList> read_module_list(std::string_view text, std::size_t volumes) {
  if (text.substr(0, first_line.size()) != first_line) return std::nullopt;
  text.remove_prefix(first_line.size());
  ModuleList list;
  std::set<VolumeId> seen;
  while (!text.empty()) {
    std::vector<VolumeId>& batch = list.emplace_back();
    for (char end = ' '; end == ' ';) {
      VolumeId volume = 0;
      const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), volume);
      if (error != std::errc{} || volume >= volumes || !seen.insert(volume).second) {
        return std::nullopt;
      }
      text.remove_prefix(static_cast<std::size_t>(at - text.data()));
      if (text.empty()) return std::nullopt;
      end = text[0];
      if (end != ' ' && end != '\n') return std::nullopt;
      text.remove_prefix(1);
      batch.push_back(volume);
    }
  }
  return list;
}

ModuleList merge(const ModuleList& mine, const ModuleList& others) {
  ModuleList merged = mine;
  std::set<VolumeId> taken;
  for (const auto& batch : mine) taken.insert(batch.begin(), batch.end());
  for (const auto& batch : others) {
    if (std::none_of(batch.begin(), batch.end(), [&](VolumeId v) { return taken.contains(v); })) {
      merged.push_back(batch);
    }
  }
  return merged;
}

}  // namespace navjit
