#include "navjit/basket.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/navigation/generic.hpp"
#include "runtime/shared.hpp"
#include "runtime/stack_pool.hpp"

namespace navjit {
namespace {

/// How many tracks ahead of the current one the innermost level of a stack is prefetched (its first
/// cache lines: twice as many). A step takes about as long as a load from memory.
constexpr std::size_t fetched_ahead = 2;

[[noreturn]] void refuse(std::size_t track, const std::string& what) {
  throw UsageError("track " + std::to_string(track) + ": " + what);
}

void require_length(std::size_t length, std::size_t tracks, const char* name) {
  if (length == tracks) return;
  throw UsageError(std::string("the array ") + name + " has " + std::to_string(length) +
                   " elements, and there are " + std::to_string(tracks) + " tracks");
}

void require_places(const Tracks& t, std::size_t tracks) {
  require_length(t.x.size(), tracks, "x");
  require_length(t.y.size(), tracks, "y");
  require_length(t.z.size(), tracks, "z");
  require_length(t.u.size(), tracks, "u");
  require_length(t.v.size(), tracks, "v");
  require_length(t.w.size(), tracks, "w");
}

bool is_finite(const Tracks& t, std::size_t i) {
  // The sum is 0 unless a number is not finite or the sum overflows.
  return 0 * (t.x[i] + t.y[i] + t.z[i]) == 0 ||
         (std::isfinite(t.x[i]) && std::isfinite(t.y[i]) && std::isfinite(t.z[i]));
}

Vec3 point_of(const Tracks& t, std::size_t i) { return {t.x[i], t.y[i], t.z[i]}; }
Vec3 direction_of(const Tracks& t, std::size_t i) { return {t.u[i], t.v[i], t.w[i]}; }

/// Whether all numbers of all tracks are valid, including those of tracks outside the world. It has
/// no branches, so that the compiler can vectorise it.
bool all_good(const Tracks& t) {
  const std::size_t count = t.state.size();
  const double *x = t.x.data(), *y = t.y.data(), *z = t.z.data();
  const double *u = t.u.data(), *v = t.v.data(), *w = t.w.data();
  int bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bad |= !detail::is_unit_vector(u[i], v[i], w[i]) | !(0 * (x[i] + y[i] + z[i]) == 0);
  }
  for (const double limit : t.limit) bad |= !(limit >= 0);
  return bad == 0;
}

/// Throws UsageError for the first track in the world that has an invalid number; there may be
/// none.
void refuse_first_bad(const Tracks& t) {
  for (std::size_t i = 0; i < t.state.size(); ++i) {
    if (!t.state[i].inside()) continue;
    if (!is_finite(t, i)) refuse(i, "the point is not finite");
    if (!detail::is_unit_vector(t.u[i], t.v[i], t.w[i]))
      refuse(i, "the direction is not a unit vector");
    if (!t.limit.empty() && !(t.limit[i] >= 0)) {
      refuse(i, "the step limit is negative, or no number");
    }
  }
}

/// Prefetches the cache lines of a stack that a step reads first.
void fetch(const kernels::NavigationStack& stack) {
  const auto* at = reinterpret_cast<const char*>(&stack);
  __builtin_prefetch(at);
  __builtin_prefetch(at + 64);
  __builtin_prefetch(at + 128);
}
void fetch_level(const kernels::NavigationStack& stack) {
  const auto* at =
      reinterpret_cast<const char*>(stack.levels + (stack.depth < 0 ? 0 : stack.depth));
  __builtin_prefetch(at);
  __builtin_prefetch(at + 64);
}

}  // namespace

Basket::Basket(Navigator navigator, std::size_t places)
    : navigator_(std::move(navigator)),
      stacks_(std::make_unique<StackPool>(places, navigator_.shared_->geometry.world().depth)) {
  if (places == 0) throw UsageError("a basket needs a place for a track");
  first_.resize(navigator_.shared_->geometry.size());
}

Basket::Basket(Basket&&) noexcept = default;
Basket::~Basket() = default;

std::size_t Basket::places() const { return stacks_->size(); }

void Basket::sort(std::span<const State> state) {
  for (const State& s : state) {
    if (s.inside() && s.volume() >= first_.size()) throw UsageError("a state is of another world");
  }
  volumes_.clear();
  volumes_.reserve(std::min(state.size(), first_.size()));
  order_.resize(state.size());
  std::uint32_t inside = 0;
  for (const State& s : state) {
    if (!s.inside()) continue;
    if (first_[s.volume()]++ == 0) volumes_.push_back(s.volume());
    ++inside;
  }
  // Counts become places, in the order in which volumes are met.
  std::uint32_t next = 0;
  for (const VolumeId volume : volumes_) {
    const std::uint32_t count = first_[volume];
    first_[volume] = next;
    next += count;
  }
  order_.resize(inside);
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (state[i].inside()) order_[first_[state[i].volume()]++] = static_cast<std::uint32_t>(i);
  }
  for (const VolumeId volume : volumes_) first_[volume] = 0;
}

State Basket::locate(std::size_t place, const Vec3& point, const Vec3& direction) {
  if (place >= places()) {
    throw UsageError("there is no place " + std::to_string(place) + " in this basket: its " +
                     std::to_string(places()) + " places count from 0; make a larger one by " +
                     "Runtime::basket() for more");
  }
  return navigator_.locate_in(stacks_->at(place), point, direction);
}

void Basket::step(const Tracks& tracks, const Steps& steps) {
  const std::size_t count = tracks.state.size();
  require_places(tracks, count);
  const bool limited = !tracks.limit.empty();
  if (limited) require_length(tracks.limit.size(), count, "limit");
  require_length(steps.length.size(), count, "length");
  require_length(steps.boundary.size(), count, "boundary");
  require_length(steps.next.size(), count, "next");
  sort(tracks.state);
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  if (!all_good(tracks)) refuse_first_bad(tracks);
  if (order_.size() < count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (tracks.state[i].inside()) continue;
      steps.length[i] = 0;
      steps.boundary[i] = 0;
      steps.next[i] = State{};
    }
  }
  const std::size_t places = stacks_->size();
  const auto stack_of = [&](std::size_t i) -> kernels::NavigationStack& {
    return stacks_->at(i < places ? i : i % places);
  };
  const std::size_t last = order_.size();
  for (std::size_t n = 0; n < last; ++n) {
    if (n + 2 * fetched_ahead < last) fetch(stack_of(order_[n + 2 * fetched_ahead]));
    if (n + fetched_ahead < last) fetch_level(stack_of(order_[n + fetched_ahead]));
    const std::uint32_t i = order_[n];
    const Step step =
        navigator_.step_of(stack_of(i), tracks.state[i], point_of(tracks, i),
                           direction_of(tracks, i), limited ? tracks.limit[i] : no_limit);
    steps.length[i] = step.length;
    steps.boundary[i] = step.boundary ? 1 : 0;
    steps.next[i] = step.next;
  }
}

}  // namespace navjit
