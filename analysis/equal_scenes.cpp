#include "analysis/equal_scenes.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <unordered_map>

#include "analysis/solid_key.hpp"

namespace navjit {
namespace {

/// Code that knows the frame and the mother is faster, but code for each case costs more to
/// compile. With more cases than this there is one code for all. A guess.
constexpr std::size_t most_cases = 4;

using Numbers = std::vector<std::uint32_t>;  ///< by volume

template <class Value>
void add(std::string& key, const Value& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Gives each different key a number, in the order in which keys occur.
class Numbering {
 public:
  std::uint32_t of(std::string key) {
    const auto next = static_cast<std::uint32_t>(known_.size());
    return known_.try_emplace(std::move(key), next).first->second;
  }

 private:
  std::unordered_map<std::string, std::uint32_t> known_;
};

/// The key of a scene's kind: its solid, and the daughters with their places.
std::string key_of(const Scene& scene, const Numbers& kinds) {
  std::string key = solid_key(scene.solid);
  for (const Daughter& d : scene.daughters) {
    add(key, kinds[d.volume]);
    add(key, d.offset);
    add(key, d.transformation.rotated);
    for (const double t : d.transformation.translation) add(key, t);
    if (!d.transformation.rotated) continue;
    for (const double r : d.transformation.rotation) add(key, r);
  }
  return key;
}

/// By volume: its kind, a number that is the same for volumes that differ only in their names and
/// in the names of what is in them.
Numbers kinds_of(const Geometry& geometry, std::span<const VolumeId> mothers_first) {
  Numbers kinds(geometry.size(), 0);
  Numbering numbering;
  for (auto v = mothers_first.rbegin(); v != mothers_first.rend(); ++v) {
    kinds[*v] = numbering.of(key_of(geometry.scene(*v), kinds));
  }
  return kinds;
}

/// What code may know of a volume besides its kind: the rotation of its touchables, if they share
/// one, and the kind of its mother, if there is only one.
struct Case {
  bool never_rotated;
  unsigned rotation;
  std::uint32_t mother;

  auto operator<=>(const Case&) const = default;
};

Case case_of(const WorldFacts& facts, const Numbers& kinds, VolumeId volume) {
  constexpr std::uint32_t several = ~0U;
  const FrameFacts& frame = facts.frames[volume];
  const auto& mother = facts.only_mothers[volume];
  return {frame.never_rotated, frame.rotation, mother ? kinds[*mother] : several};
}

/// Kinds, which are split into cases if a kind has few of them.
Numbers with_cases(const WorldFacts& facts, std::span<const VolumeId> volumes,
                   const Numbers& kinds) {
  std::unordered_map<std::uint32_t, std::set<Case>> cases;
  for (const VolumeId v : volumes) {
    std::set<Case>& of_kind = cases[kinds[v]];
    if (of_kind.size() <= most_cases) of_kind.insert(case_of(facts, kinds, v));
  }
  Numbers told(kinds.size(), 0);
  std::map<std::pair<std::uint32_t, Case>, std::uint32_t> known;
  for (const VolumeId v : volumes) {
    const bool few = cases[kinds[v]].size() <= most_cases;
    const Case of = few ? case_of(facts, kinds, v) : Case{};
    const auto next = static_cast<std::uint32_t>(known.size());
    told[v] = known.try_emplace({kinds[v], of}, next).first->second;
  }
  return told;
}

/// The value that all volumes have in common; nothing if they differ.
template <class Of>
auto common(std::span<const VolumeId> volumes, const Of& of) -> decltype(of(volumes[0])) {
  const auto first = of(volumes[0]);
  const bool all =
      std::all_of(volumes.begin(), volumes.end(), [&](VolumeId v) { return of(v) == first; });
  return all ? first : decltype(of(volumes[0])){};
}

FrameFacts frame_of_all(const WorldFacts& facts, std::span<const VolumeId> equals) {
  const FrameFacts& first = facts.frames[equals[0]];
  const bool same = std::all_of(equals.begin(), equals.end(), [&](VolumeId v) {
    const FrameFacts& frame = facts.frames[v];
    return frame.never_rotated == first.never_rotated && frame.rotation == first.rotation;
  });
  FrameFacts frame = same ? first : FrameFacts{};
  if (equals.size() > 1) frame.only_translation.reset();
  return frame;
}

bool has_stand_ins(const Geometry& geometry, const WorldFacts& facts,
                   std::span<const VolumeId> equals) {
  const auto& first = geometry.scene(equals[0]).daughters;
  const bool others = std::any_of(equals.begin(), equals.end(), [&](VolumeId v) {
    const auto& own = geometry.scene(v).daughters;
    return !std::equal(own.begin(), own.end(), first.begin(), first.end(),
                       [](const Daughter& a, const Daughter& b) { return a.volume == b.volume; });
  });
  if (others) return true;
  // Code does not enter leaves, so it makes no difference which leaf it is.
  std::map<VolumeId, VolumeId> met;  // by the first of equals
  return std::any_of(first.begin(), first.end(), [&](const Daughter& d) {
    return !geometry.scene(d.volume).daughters.empty() &&
           met.try_emplace(facts.first_equal[d.volume], d.volume).first->second != d.volume;
  });
}

}  // namespace

std::vector<VolumeId> equal_scenes(const Geometry& geometry, const WorldFacts& facts,
                                   std::span<const VolumeId> mothers_first) {
  const Numbers told = with_cases(facts, mothers_first, kinds_of(geometry, mothers_first));
  // Volumes of one kind and case may have daughters that were split into cases, since these also
  // occur in other mothers.
  Numbers groups(geometry.size(), 0);
  Numbering numbering;
  for (auto v = mothers_first.rbegin(); v != mothers_first.rend(); ++v) {
    std::string key;
    add(key, told[*v]);
    for (const Daughter& d : geometry.scene(*v).daughters) add(key, groups[d.volume]);
    groups[*v] = numbering.of(std::move(key));
  }
  std::vector<VolumeId> first(geometry.size());
  std::unordered_map<std::uint32_t, VolumeId> known;
  for (VolumeId v = 0; v < first.size(); ++v) {
    first[v] = facts.reachable[v] ? known.try_emplace(groups[v], v).first->second : v;
  }
  return first;
}

std::vector<EqualFacts> facts_of_equals(const Geometry& geometry, const WorldFacts& facts) {
  std::vector<EqualFacts> all(geometry.size());
  for (VolumeId v = 0; v < all.size(); ++v) {
    const std::vector<VolumeId>& equals = facts.equals[v];
    if (equals.empty()) continue;
    all[v].frame = frame_of_all(facts, equals);
    all[v].only_mother = common(equals, [&](VolumeId e) { return facts.only_mothers[e]; });
    all[v].mothers = common(equals, [&](VolumeId e) -> std::optional<VolumeId> {
      const auto& mother = facts.only_mothers[e];
      return mother ? std::optional(facts.first_equal[*mother]) : std::nullopt;
    });
    all[v].stand_ins = has_stand_ins(geometry, facts, equals);
  }
  return all;
}

}  // namespace navjit
