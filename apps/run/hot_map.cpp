#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "apps/picture/make.hpp"
#include "apps/run/page.hpp"

namespace navjit::apps {
namespace {

/// s; half of it is for what the first look is wrong about.
constexpr double budget_s = 1;
constexpr int widest = 200, narrowest = 24;

std::string title_of(const char* what, const std::vector<double>& ns) {
  double sum = 0;
  for (const double each : ns) sum += each;
  char text[64];
  std::snprintf(text, sizeof text, "%s: %.3g us a ray", what,
                sum / static_cast<double>(ns.size()) / 1000);
  return text;
}

}  // namespace

std::string hot_map_of(Runtime& runtime, const RuntimeOptions& options, unsigned threads) {
  using Clock = std::chrono::steady_clock;
  RuntimeOptions off = options;
  off.jit = JitMode::off;
  off.cache = {};
  off.plugin = {};
  Runtime generic(runtime.detector(), off);
  const World& world = runtime.world();
  const picture::Visible visible = picture::visible_of(world, {});
  picture::Frame frame{.width = 16, .height = 12, .threads = threads};
  const Extent box = picture::seen_box(generic, visible, {});
  frame.view = picture::view_of(box, world, {}, frame.width, frame.height);
  const Clock::time_point begun = Clock::now();
  picture::values(generic, visible, frame, picture::Quantity::steps);
  const std::chrono::duration<double> took = Clock::now() - begun;
  const double pixels = budget_s / took.count() * (16 * 12) / (2 * picture::time_passes);
  frame.width = static_cast<int>(std::min<double>(widest, std::sqrt(pixels * 4 / 3)));
  if (frame.width < narrowest) return "";
  frame.height = frame.width * 3 / 4;
  frame.view = picture::view_of(box, world, {}, frame.width, frame.height);
  const picture::Times times = picture::times(generic, runtime, frame);
  picture::Sheet sheet;
  sheet.scale = picture::scale_of(times.before, false, picture::ColourMap::hot);
  sheet.unit = "ns";
  // Small pictures are shown larger, pixel by pixel.
  const int zoom = std::max(1, 320 / frame.width);
  const auto panel = [&](const std::vector<double>& ns, const char* what) {
    const picture::Image small = picture::paint(ns, frame.width, frame.height, *sheet.scale);
    picture::Image large(zoom * small.width, zoom * small.height, {});
    for (int y = 0; y < large.height; ++y) {
      for (int x = 0; x < large.width; ++x) large.at(x, y) = small.at(x / zoom, y / zoom);
    }
    sheet.panels.push_back({std::move(large), title_of(what, ns)});
  };
  panel(times.before, "generic");
  if (options.jit != JitMode::off) panel(times.after, "this run's navigators");
  return picture::png_sheet(sheet);
}

}  // namespace navjit::apps
