#include "runtime/verify.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "geometry/navigation/generic.hpp"
#include "runtime/processor_time.hpp"

namespace navjit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string describe(const Sample& s, const char* what, double right, double wrong) {
  char text[512];
  std::snprintf(text, sizeof text,
                "%s: %.17g instead of %.17g in touchable %llu at (%.17g, %.17g, %.17g) along "
                "(%.17g, %.17g, %.17g)",
                what, wrong, right, static_cast<unsigned long long>(s.touchable), s.point.x,
                s.point.y, s.point.z, s.direction.x, s.direction.y, s.direction.z);
  return text;
}

/// Sets what the stack of a sample, in a volume with daughters, knows of the last step.
void bring_what_was_left(NavigationStack& stack, const Sample& s) {
  stack.levels[stack.depth + 1].daughter = s.left;
  if (s.left_for_good) {
    stack.left = {{s.point.x, s.point.y, s.point.z}, s.touchable, s.left, -1};
  }
}

/// Makes the stack as it was when the sample was recorded, or made up.
void bring_to(const Geometry& geometry, NavigationStack& stack, const Sample& s) {
  generic::restore(geometry, stack, s.touchable);
  if (!geometry.scene(s.volume).daughters.empty()) {
    bring_what_was_left(stack, s);
  }
}

/// The two stacks of a comparison. They are large, so they are made once.
struct Pair {
  NavigationStack generic, specialised;
};

/// Says where two stacks that are not identical end, or in what else they differ.
std::string describe_ends(const Sample& s, const std::string& when, const Pair& stacks) {
  const auto of = [](const NavigationStack& stack, auto StackLevel::*number) {
    return stack.depth < 0 ? -1.0 : static_cast<double>(stack.levels[stack.depth].*number);
  };
  const auto differ = [&](auto StackLevel::*number) {
    return of(stacks.generic, number) != of(stacks.specialised, number);
  };
  const auto as = [&](const char* what, auto StackLevel::*number) {
    return describe(s, (what + when).c_str(), of(stacks.generic, number),
                    of(stacks.specialised, number));
  };
  if (differ(&StackLevel::touchable)) return as("touchable ", &StackLevel::touchable);
  if (differ(&StackLevel::volume)) return as("volume ", &StackLevel::volume);
  return describe(s, ("frame or mothers " + when).c_str(), stacks.generic.depth,
                  stacks.specialised.depth);
}

std::string verify_step(const Geometry& geometry, const kernels::Context& context,
                        const kernels::DispatchEntry& specialised, const Sample& s, Pair& stacks) {
  bring_to(geometry, stacks.generic, s);
  copy(stacks.generic, stacks.specialised);
  kernels::set_ray(stacks.specialised, s.direction.x, s.direction.y, s.direction.z);
  bring_to(geometry, stacks.specialised, s);
  const double wrong = specialised.step(&stacks.specialised, &context, specialised.data, s.point.x,
                                        s.point.y, s.point.z, s.limit);
  if (wrong < 0) {
    return identical(stacks.generic, stacks.specialised)
               ? ""
               : describe(s, "a state was changed in spite of a bail-out", 0, wrong);
  }
  const double right = generic::step(geometry, stacks.generic, s.point, s.direction, s.limit);
  if (!kernels::same_bits(right, wrong)) {
    return describe(s, "step length", right, wrong);
  }
  if (stacks.generic.boundary != stacks.specialised.boundary) {
    return describe(s, "boundary flag", stacks.generic.boundary, stacks.specialised.boundary);
  }
  if (!identical(stacks.generic, stacks.specialised)) {
    return describe_ends(s, "after the step", stacks);
  }
  return "";
}

std::string verify_relocate(const Geometry& geometry, const kernels::Context& context,
                            const kernels::DispatchEntry& specialised, const Sample& s, int blocked,
                            Pair& stacks) {
  generic::restore(geometry, stacks.generic, s.touchable);
  copy(stacks.generic, stacks.specialised);
  kernels::set_ray(stacks.specialised, s.direction.x, s.direction.y, s.direction.z);
  generic::relocate(geometry, stacks.generic, s.point, s.direction, blocked);
  specialised.relocate(&stacks.specialised, &context, specialised.data, s.point.x, s.point.y,
                       s.point.z, blocked);
  return identical(stacks.generic, stacks.specialised)
             ? ""
             : describe_ends(s, "after relocation", stacks);
}

std::string verify_safety(const Geometry& geometry, const kernels::Context& context,
                          const kernels::DispatchEntry& specialised, const Sample& s,
                          NavigationStack& stack) {
  generic::restore(geometry, stack, s.touchable);
  const double whole = generic::safety(geometry, stack, s.point);
  for (const double enough : {infinity, whole, 0.5 * whole}) {
    const double right = generic::safety(geometry, stack, s.point, enough);
    const double wrong = specialised.safety(&stack, &context, specialised.safety_data, s.point.x,
                                            s.point.y, s.point.z, enough);
    if (!kernels::same_bits(right, wrong)) return describe(s, "safety", right, wrong);
  }
  return "";
}

}  // namespace

std::string verify(const Geometry& geometry, const kernels::Context& context,
                   const kernels::DispatchEntry& specialised, VolumeId volume,
                   std::span<const Sample> samples) {
  const auto stacks = std::make_unique<Pair>();
  stacks->generic.depth = stacks->specialised.depth = -1;
  const std::size_t daughters = geometry.scene(volume).daughters.size();
  std::size_t n = 0, verified = 0;
  for (const Sample& s : samples) {
    if (s.volume != volume) continue;
    ++verified;
    std::string problem = verify_step(geometry, context, specialised, s, *stacks);
    if (problem.empty()) {
      problem = verify_relocate(geometry, context, specialised, s, -1, *stacks);
    }
    if (problem.empty()) {
      problem = verify_safety(geometry, context, specialised, s, stacks->generic);
    }
    if (problem.empty() && daughters > 0) {
      problem = verify_relocate(geometry, context, specialised, s,
                                static_cast<int>(n++ % daughters), *stacks);
    }
    if (!problem.empty()) return problem;
  }
  return verified > 0 ? "" : std::string(no_state_to_verify_on);
}

double time_per_step(const Geometry& geometry, const kernels::Context& context,
                     const kernels::DispatchEntry& entry, std::span<const Sample> samples) {
  if (samples.empty()) return 0;
  // There are few enough samples for the stacks to stay in near caches. Each pass has another
  // order: if the order were always the same, processors would learn which way each branch goes,
  // which they cannot do in a run.
  const std::size_t count = std::min<std::size_t>(samples.size(), 256);
  std::vector<NavigationStack> stacks(count);
  std::vector<char> has_daughters(count);
  for (std::size_t i = 0; i < count; ++i) {
    stacks[i].depth = -1;
    generic::restore(geometry, stacks[i], samples[i].touchable);
    has_daughters[i] = geometry.scene(samples[i].volume).daughters.empty() ? 0 : 1;
  }
  const auto work = std::make_unique<NavigationStack>();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937 random(1);
  const auto pass = [&](bool step) {
    const double start = thread_seconds();
    for (const std::size_t i : order) {
      const Sample& s = samples[i];
      copy(stacks[i], *work);
      kernels::set_ray(*work, s.direction.x, s.direction.y, s.direction.z);
      if (has_daughters[i] != 0) bring_what_was_left(*work, s);
      if (step) {
        entry.step(work.get(), &context, entry.data, s.point.x, s.point.y, s.point.z, s.limit);
      }
    }
    return 1e9 * (thread_seconds() - start) / static_cast<double>(count);
  };
  // The time of slow navigators is known well enough after few passes.
  constexpr int most_passes = 8, least_passes = 2;
  constexpr double long_enough_ns = 1e6;
  double with = infinity, without = infinity, spent = 0;
  for (int n = 0; n < least_passes || (n < most_passes && spent < long_enough_ns); ++n) {
    std::shuffle(order.begin(), order.end(), random);
    const double ns = pass(true);
    spent += ns * static_cast<double>(count);
    with = std::min(with, ns);
    without = std::min(without, pass(false));
  }
  return std::max(with - without, 0.1);
}

}  // namespace navjit
