#include "observe/marks.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "geometry/model/order.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

constexpr std::string_view sensitive = "SensDet";
constexpr std::string_view region = "Region";

/// Whether a tag only says how a volume is drawn, which changes nothing for particles.
bool only_drawn(const Auxiliary& tag) {
  for (const std::string_view type : {"Color", "Colour", "VisAttributes", "Visibility"}) {
    if (tag.type == type) return true;
  }
  return false;
}

/// Appends a tag as text, such that two volumes have the same tags if their texts are equal. A text
/// in a file cannot be taken for two, since each is preceded by its length.
void append_text(std::string& text, const Auxiliary& tag) {
  for (const std::string* part : {&tag.type, &tag.value, &tag.unit}) {
    text += std::to_string(part->size()) + ':' + *part;
  }
  text += '(';
  for (const Auxiliary& child : tag.children) append_text(text, child);
  text += ')';
}

/// Cuts, fields, step limits and everything else that a file says of a volume besides its detector
/// and region.
std::string tags_of(const LogicalVolume& volume, bool with_thresholds) {
  std::string text;
  if (!volume.auxiliaries) return text;
  for (const Auxiliary& tag : *volume.auxiliaries) {
    if (tag.type == sensitive || tag.type == region || only_drawn(tag)) continue;
    if (!with_thresholds && is_threshold(tag)) continue;
    append_text(text, tag);
  }
  return text;
}

/// A name without the volume's address, which Geant4 appends.
std::string_view without_address(std::string_view name) { return name.substr(0, name.find("0x")); }

/// The region that each volume is the root of, as a number from 1; 0 for none.
std::vector<int> region_roots(const World& world) {
  std::map<std::string, int> regions;
  const auto number_of = [&](const std::string& name) {
    return regions.try_emplace(name, static_cast<int>(regions.size()) + 1).first->second;
  };
  std::vector<int> roots(world.volumes.size(), 0);
  if (world.auxiliaries) {
    for (const Auxiliary& tag : *world.auxiliaries) {
      if (tag.type != region) continue;
      for (const Auxiliary& child : tag.children) {
        if (child.type != "volume") continue;
        for (std::size_t v = 0; v < roots.size(); ++v) {
          const std::string& name = world.volumes[v].name;
          if (name == child.value || without_address(name) == without_address(child.value)) {
            roots[v] = number_of(tag.value);
          }
        }
      }
    }
  }
  for (std::size_t v = 0; v < roots.size(); ++v) {
    const Auxiliary* tag = find_auxiliary(world.volumes[v].auxiliaries, region);
    if (tag != nullptr) roots[v] = number_of(tag->value);
  }
  return roots;
}

}  // namespace

bool is_threshold(const Auxiliary& tag) {
  for (const std::string_view type : {"gammaECut", "electronECut", "positronECut", "protonECut"}) {
    if (tag.type == type) return true;
  }
  return false;
}

Marks find_marks(const World& world, const Observation& observation,
                 const std::vector<std::uint32_t>& group_of) {
  const std::size_t count = world.volumes.size();
  Marks marks;
  marks.observed.resize(count);
  marks.heads.resize(count);
  marks.ambiguous.resize(count);
  for (const std::string& name : observation.volumes) {
    bool found = false;
    for (std::size_t v = 0; v < count; ++v) {
      if (world.volumes[v].name != name) continue;
      marks.observed[v] = found = true;
    }
    if (!found) throw GeometryError("there is no volume '" + name + "' to observe");
  }
  std::map<std::string, std::uint32_t> tags;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> kinds;
  marks.own.resize(count);
  marks.tags.resize(count);
  marks.settings.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    const LogicalVolume& volume = world.volumes[v];
    if (find_auxiliary(volume.auxiliaries, sensitive) != nullptr) marks.observed[v] = true;
    const std::uint32_t material =
        volume.material < group_of.size() ? group_of[volume.material] : volume.material;
    const auto number_of = [&tags](std::string text) {
      return tags.try_emplace(std::move(text), static_cast<std::uint32_t>(tags.size()))
          .first->second;
    };
    marks.tags[v] = number_of(tags_of(volume, true));
    marks.settings[v] = number_of(tags_of(volume, false));
    marks.own[v] =
        kinds.try_emplace({material, marks.tags[v]}, static_cast<std::uint32_t>(kinds.size()))
            .first->second;
  }
  // Regions are inherited down the tree by daughters that are not roots of regions themselves.
  const std::vector<int> roots = region_roots(world);
  std::vector<std::optional<int>> regions(count);
  std::vector<VolumeId> order = daughters_first(world);
  std::reverse(order.begin(), order.end());
  for (const VolumeId v : order) {
    marks.heads[v] = roots[v] != 0;
    if (roots[v] != 0) {
      regions[v] = roots[v];
      marks.ambiguous[v] = false;
    }
    if (!regions[v]) regions[v] = 0;
    for (const Placement& placement : world.volumes[v].daughters) {
      const VolumeId d = placement.volume;
      if (roots[d] != 0) continue;
      if (marks.ambiguous[v] || (regions[d] && *regions[d] != *regions[v])) {
        marks.ambiguous[d] = true;
      }
      regions[d] = regions[v];
    }
  }
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> classes;
  marks.classes.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    marks.classes[v] = classes
                           .try_emplace({marks.own[v], regions[v].value_or(0)},
                                        static_cast<std::uint32_t>(classes.size()))
                           .first->second;
  }
  return marks;
}

}  // namespace navjit
