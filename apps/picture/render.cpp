#include "apps/picture/render.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "common/clock.hpp"
#include "common/material_budget.hpp"
#include "common/parallel.hpp"
#include "common/passage.hpp"

namespace navjit::picture {
namespace {

using common::Leg;
using common::PassageEnd;

std::size_t pixels_of(const Frame& frame) {
  return static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
}

/// Calls `pixel(navigator, ray, number)` for each. `rows_before` were done in passes before.
template <class Pixel>
void for_each_pixel(Runtime& runtime, const Frame& frame, Pixel&& pixel, int rows_before = 0) {
  std::atomic<int> next{0};
  std::atomic<bool> stop{false};
  std::mutex telling;
  int done = rows_before;
  common::in_parallel(frame.threads, stop, [&] {
    Navigator navigator = runtime.navigator();
    for (int y; !stop && (y = next.fetch_add(1)) < frame.height;) {
      for (int x = 0; x < frame.width; ++x) {
        pixel(navigator, frame.view.ray(x, y, frame.width, frame.height),
              static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                  static_cast<std::size_t>(x));
      }
      if (!frame.progress) continue;
      const std::lock_guard lock(telling);
      frame.progress(++done);
    }
  });
}

/// From surroundings 0.3 to full light, by a lamp behind and above the viewer's left shoulder.
float light_of(const View& view, const Ray& ray, Vec3 normal) {
  if (dot(normal, ray.direction) > 0) normal = -1 * normal;
  const Vec3 lamp = -0.8 * view.forward + 0.48 * view.up + -0.36 * view.right;
  const double light = 0.3 + 0.7 * std::max(0.0, dot(normal, lamp));
  return static_cast<float>(std::isfinite(light) ? std::min(light, 1.0) : 1.0);
}

Surface surface_at(Navigator& navigator, const View& view, const Ray& ray, const Leg& leg,
                   const Vec3* face) {
  Vec3 normal = ray.direction;
  if (face != nullptr) {
    normal = *face;
  } else if (leg.before.inside()) {
    normal = navigator.boundary_normal(leg.before, leg.state, leg.point);
  } else if (leg.from > 0) {
    normal = navigator.normal(leg.state, leg.point);
  }
  return {leg.state.volume(), light_of(view, ray, normal), leg.state.touchable()};
}

/// By volume: what a mm of it adds to a sum.
std::vector<double> rates_of(const World& world, const Visible& visible, Quantity quantity) {
  std::vector<double> rates(world.volumes.size(), 0);
  const std::vector<common::MaterialRates> of = common::material_rates(world);
  for (std::size_t v = 0; v < rates.size(); ++v) {
    switch (quantity) {
      case Quantity::path:
        rates[v] = visible.opaque[v] ? 1 : 0;
        break;
      case Quantity::radiation_lengths:
        rates[v] = visible.counted[v] ? of[v].radiation_lengths : 0;
        break;
      case Quantity::mass:
        rates[v] = visible.counted[v] ? of[v].mass : 0;
        break;
      case Quantity::steps:
        break;
    }
  }
  return rates;
}

}  // namespace

std::vector<Surface> surfaces(Runtime& runtime, const Visible& visible, const Frame& frame) {
  std::vector<Surface> seen(pixels_of(frame));
  for_each_pixel(runtime, frame, [&](Navigator& navigator, const Ray& ray, std::size_t number) {
    const std::vector<Gap> gaps = gaps_of(frame.cuts, ray);
    const PassageEnd end =
        pass_uncut(navigator, runtime.world(), ray, gaps, [&](const Leg& leg, const Vec3* face) {
          if (!visible.opaque[leg.state.volume()] || !(leg.from < leg.to)) return true;
          seen[number] = surface_at(navigator, frame.view, ray, leg, face);
          return false;
        });
    if (end == PassageEnd::stuck) seen[number].volume = Surface::stuck;
  });
  return seen;
}

std::vector<Surface> slice(Runtime& runtime, const Visible& visible, const Frame& frame,
                           double depth) {
  std::vector<Surface> seen(pixels_of(frame));
  for_each_pixel(runtime, frame, [&](Navigator& navigator, const Ray& ray, std::size_t number) {
    const State state = navigator.locate(ray.position + depth * ray.direction, ray.direction);
    if (!state.inside() || state.volume() == runtime.world().top) return;
    if (visible.counted[state.volume()]) seen[number] = {state.volume(), 1, state.touchable()};
  });
  return seen;
}

std::vector<double> values(Runtime& runtime, const Visible& visible, const Frame& frame,
                           Quantity quantity) {
  const std::vector<double> rates = rates_of(runtime.world(), visible, quantity);
  std::vector<double> sums(pixels_of(frame));
  for_each_pixel(runtime, frame, [&](Navigator& navigator, const Ray& ray, std::size_t number) {
    const std::vector<Gap> gaps =
        quantity == Quantity::steps ? std::vector<Gap>{} : gaps_of(frame.cuts, ray);
    double sum = 0;
    const PassageEnd end =
        pass_uncut(navigator, runtime.world(), ray, gaps, [&](const Leg& leg, const Vec3*) {
          sum += quantity == Quantity::steps ? 1 : rates[leg.state.volume()] * (leg.to - leg.from);
          return true;
        });
    sums[number] = end == PassageEnd::stuck ? std::numeric_limits<double>::quiet_NaN() : sum;
  });
  return sums;
}

Times times(Runtime& before, Runtime& after, const Frame& frame) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Times all{std::vector<double>(pixels_of(frame), infinity),
            std::vector<double>(pixels_of(frame), infinity)};
  const double ns = common::ns_per_tick();
  int rows = 0;
  for (int pass = 0; pass < time_passes; ++pass) {
    for (const bool first : {true, false}) {
      std::vector<double>& least = first ? all.before : all.after;
      Runtime& runtime = first ? before : after;
      for_each_pixel(
          runtime, frame,
          [&](Navigator& navigator, const Ray& ray, std::size_t number) {
            const std::uint64_t start = ticks();
            common::pass(navigator, runtime.world(), ray, [](const Leg&) { return true; });
            const double took = ns * static_cast<double>(ticks() - start);
            least[number] = std::min(least[number], took);
          },
          rows);
      rows += frame.height;
    }
  }
  return all;
}

}  // namespace navjit::picture
