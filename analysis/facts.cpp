#include "analysis/facts.hpp"

#include <algorithm>

#include "analysis/equal_scenes.hpp"

namespace navjit {
namespace {

/// The volumes in the tree, mothers before daughters; volumes outside the tree do not occur.
std::vector<VolumeId> topological_order(const Geometry& geometry) {
  const std::size_t n = geometry.size();
  std::vector<std::uint32_t> waiting(n, 0);
  std::vector<char> seen(n, 0);
  std::vector<VolumeId> pending{geometry.world().top};
  seen[geometry.world().top] = 1;
  while (!pending.empty()) {
    const VolumeId volume = pending.back();
    pending.pop_back();
    for (const Daughter& d : geometry.scene(volume).daughters) {
      ++waiting[d.volume];
      if (!seen[d.volume]) {
        seen[d.volume] = 1;
        pending.push_back(d.volume);
      }
    }
  }
  std::vector<VolumeId> order{geometry.world().top};
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (const Daughter& d : geometry.scene(order[i]).daughters) {
      if (--waiting[d.volume] == 0) order.push_back(d.volume);
    }
  }
  return order;
}

/// The different frames of a volume, collected until there are too many.
struct FrameSet {
  std::vector<std::array<double, 9>> rotations;
  bool many_rotations = false;
  bool turned = false;    ///< on some way to it something turns, though the turns may cancel out
  bool unturned = false;  ///< on some way to it nothing turns
  std::vector<std::array<double, 3>> translations;

  void add_rotation(const std::array<double, 9>& r) {
    if (many_rotations || std::find(rotations.begin(), rotations.end(), r) != rotations.end()) {
      return;
    }
    rotations.push_back(r);
    many_rotations = rotations.size() > 16;
  }
};

constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

StackLevel level_of(const std::array<double, 9>& rotation,
                    const std::array<double, 3>& translation) {
  StackLevel level{};
  std::copy(translation.begin(), translation.end(), level.translation);
  std::copy(rotation.begin(), rotation.end(), level.own_rotation);
  return level;
}

/// The daughter's frame, composed by the navigator's own functions, so that constants have the same
/// bits.
void compose(const std::array<double, 9>& rotation, const std::array<double, 3>& translation,
             const Transformation& t, std::array<double, 9>& out_rotation,
             std::array<double, 3>& out_translation) {
  NavigationStack stack{};
  stack.levels[0] = level_of(rotation, translation);
  stack.levels[0].rotation = rotation == identity ? nullptr : stack.levels[0].own_rotation;
  if (t.rotated) {
    kernels::push_rotated(&stack, 0, 0, 0, t.translation[0], t.translation[1], t.translation[2],
                          t.rotation);
  } else {
    kernels::push_translated(&stack, 0, 0, 0, t.translation[0], t.translation[1], t.translation[2]);
  }
  const StackLevel& level = stack.levels[1];
  std::copy_n(level.translation, 3, out_translation.begin());
  if (level.rotation == nullptr) {
    out_rotation = identity;
  } else {
    std::copy_n(level.rotation, 9, out_rotation.begin());
  }
}

}  // namespace

WorldFacts analyse_world(const Geometry& geometry) {
  const std::size_t n = geometry.size();
  WorldFacts facts;
  facts.frames.resize(n);
  facts.only_mothers.resize(n);
  facts.touchables.assign(n, 0);
  facts.reachable.assign(n, 0);
  std::vector<char> several_mothers(n, 0);
  std::vector<FrameSet> sets(n);
  const VolumeId top = geometry.world().top;
  facts.touchables[top] = 1;
  sets[top].rotations.push_back(identity);
  sets[top].translations.push_back({0, 0, 0});
  sets[top].unturned = true;
  const std::vector<VolumeId> mothers_first = topological_order(geometry);
  for (const VolumeId volume : mothers_first) {
    facts.reachable[volume] = 1;
    const FrameSet& outer = sets[volume];
    for (const Daughter& d : geometry.scene(volume).daughters) {
      facts.touchables[d.volume] += facts.touchables[volume];
      auto& mother = facts.only_mothers[d.volume];
      if (mother && *mother != volume) several_mothers[d.volume] = 1;
      mother = volume;
      FrameSet& inner = sets[d.volume];
      inner.many_rotations |= outer.many_rotations;
      inner.turned |= outer.turned || d.transformation.rotated;
      inner.unturned |= outer.unturned && !d.transformation.rotated;
      std::array<double, 9> rotation;
      std::array<double, 3> translation;
      for (const auto& r : outer.rotations) {
        compose(r, {0, 0, 0}, d.transformation, rotation, translation);
        inner.add_rotation(rotation);
      }
      if (facts.touchables[d.volume] == 1 && outer.translations.size() == 1 &&
          outer.rotations.size() == 1) {
        compose(outer.rotations[0], outer.translations[0], d.transformation, rotation, translation);
        inner.translations = {translation};
      }
    }
  }
  std::map<std::array<double, 9>, unsigned> rotations;
  for (std::size_t v = 0; v < n; ++v) {
    if (several_mothers[v]) facts.only_mothers[v].reset();
    const FrameSet& set = sets[v];
    FrameFacts& frame = facts.frames[v];
    if (!set.many_rotations && set.rotations.size() == 1) {
      frame.never_rotated = set.rotations[0] == identity && !set.turned;
      // Where turns cancel out the navigation stack has a rotation, and where nothing turns it has
      // none: a volume with both is navigated as one with several rotations.
      if (!frame.never_rotated && !set.unturned) {
        frame.only_rotation = set.rotations[0];
        const auto next = static_cast<unsigned>(rotations.size() + 1);
        frame.rotation = rotations.try_emplace(set.rotations[0], next).first->second;
      }
    }
    if (facts.touchables[v] == 1 && set.translations.size() == 1) {
      frame.only_translation = set.translations[0];
    }
  }
  facts.first_equal = equal_scenes(geometry, facts, mothers_first);
  facts.equals.resize(n);
  for (std::size_t v = 0; v < n; ++v) {
    facts.equals[facts.first_equal[v]].push_back(static_cast<VolumeId>(v));
  }
  facts.of_equals = facts_of_equals(geometry, facts);
  // One navigator for several volumes cannot have the place of one of them as a constant.
  for (std::size_t v = 0; v < n; ++v) {
    if (facts.equals[facts.first_equal[v]].size() > 1) facts.frames[v].only_translation.reset();
  }
  return facts;
}

}  // namespace navjit
