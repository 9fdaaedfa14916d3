#include "apps/picture/make.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "navjit/errors.hpp"

namespace navjit::picture {
namespace {

std::string text_of(const char* format, double a, double b = 0) {
  char text[96];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// "12.4 m".
std::string length_text(double mm) {
  if (mm >= 1000) return text_of("%.3g m", mm / 1000);
  if (mm >= 10) return text_of("%.3g cm", mm / 10);
  return text_of("%.3g mm", mm);
}

/// Scenes are bound to data, which takes no compiler: a picture is done before code would pay.
RuntimeOptions quick(const RuntimeOptions& asked) {
  RuntimeOptions options = asked;
  options.cache = {};
  options.specialiser.constants = false;
  options.specialiser.structures = false;
  options.specialiser.solids = false;
  options.specialiser.safety = false;
  return options;
}

void add_entries(const World& world, const std::vector<Surface>& seen, ColourBy by, Made& made) {
  std::map<std::string, std::pair<Rgb, std::uint64_t>> found;
  std::vector<std::uint64_t> pixels(world.volumes.size());
  for (const Surface& surface : seen) {
    if (surface.volume < pixels.size()) ++pixels[surface.volume];
  }
  for (VolumeId v = 0; v < pixels.size(); ++v) {
    if (pixels[v] == 0) continue;
    auto& entry = found[meaning_of(world, v, by)];
    // Volumes of one name have colours of their own; the one of most pixels stands for them.
    if (entry.second == 0 || by != ColourBy::volume) entry.first = colour_of(world, v, by);
    entry.second += pixels[v];
  }
  std::vector<std::pair<std::uint64_t, Entry>> sorted;
  for (const auto& [meaning, entry] : found) {
    sorted.push_back({entry.second, {entry.first, meaning}});
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [count, entry] : sorted) {
    made.shares.push_back(static_cast<double>(count) / static_cast<double>(seen.size()));
    made.sheet.entries.push_back(std::move(entry));
  }
}

void tell_stuck(std::uint64_t stuck, Made& made) {
  if (stuck == 0) return;
  made.lines.push_back(std::to_string(stuck) + " rays got stuck; their pixels are magenta");
}

const char* unit_of(Mode mode) {
  switch (mode) {
    case Mode::path:
      return "mm";
    case Mode::radiation_lengths:
      return "rad. lengths";
    case Mode::mass:
      return "g/cm2";
    case Mode::steps:
      return "steps";
    case Mode::time:
      return "ns";
    case Mode::surface:
      break;
  }
  return "";
}

Quantity quantity_of(Mode mode) {
  switch (mode) {
    case Mode::radiation_lengths:
      return Quantity::radiation_lengths;
    case Mode::mass:
      return Quantity::mass;
    case Mode::steps:
      return Quantity::steps;
    default:
      return Quantity::path;
  }
}

double mean(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

void make_surfaces(Runtime& runtime, const Visible& visible, const Frame& frame,
                   const Request& request, std::optional<double> depth, Made& made) {
  const std::vector<Surface> seen =
      depth ? slice(runtime, visible, frame, *depth) : surfaces(runtime, visible, frame);
  const World& world = runtime.world();
  made.sheet.panels.push_back(
      {paint(world, seen, frame.width, frame.height, request.colour, !request.flat), ""});
  add_entries(world, seen, request.colour, made);
  tell_stuck(
      static_cast<std::uint64_t>(std::count_if(
          seen.begin(), seen.end(), [](const Surface& s) { return s.volume == Surface::stuck; })),
      made);
}

void make_values(Runtime& runtime, const Visible& visible, const Frame& frame,
                 const Request& request, Made& made) {
  const std::vector<double> sums = values(runtime, visible, frame, quantity_of(request.mode));
  const ColourMap map = request.mode == Mode::steps ? ColourMap::hot : ColourMap::cool;
  made.sheet.scale = scale_of(sums, request.logarithmic, map);
  made.sheet.unit = unit_of(request.mode);
  made.sheet.panels.push_back({paint(sums, frame.width, frame.height, *made.sheet.scale), ""});
  double most = 0;
  std::uint64_t stuck = 0;
  for (const double sum : sums) {
    if (std::isnan(sum))
      ++stuck;
    else
      most = std::max(most, sum);
  }
  made.lines.push_back(text_of("mean %.4g, largest %.4g ", mean(sums), most) +
                       unit_of(request.mode));
  tell_stuck(stuck, made);
}

void make_times(const std::shared_ptr<const World>& world, const Frame& frame,
                const Request& request, Made& made) {
  RuntimeOptions off = request.runtime;
  off.jit = JitMode::off;
  off.cache = {};
  Runtime generic(world, off), specialised(world, request.runtime);
  // Two looks: what is hot in the first is compiled by the end of the second.
  for (int look = 0; look < 2; ++look) {
    Frame unseen = frame;
    if (look == 1) {
      unseen.progress = [&](int rows) { frame.progress(rows + frame.height); };
    }
    if (!frame.progress) unseen.progress = nullptr;
    values(specialised, visible_of(*world, {}), unseen, Quantity::steps);
    specialised.wait_until_idle();
  }
  Frame measured = frame;
  if (frame.progress)
    measured.progress = [&](int rows) { frame.progress(rows + 2 * frame.height); };
  const Times took = times(generic, specialised, measured);
  made.sheet.scale = scale_of(took.before, request.logarithmic, ColourMap::hot);
  made.sheet.unit = unit_of(Mode::time);
  const double before = mean(took.before), after = mean(took.after);
  made.sheet.panels.push_back({paint(took.before, frame.width, frame.height, *made.sheet.scale),
                               text_of("generic: %.3g us a ray", before / 1000)});
  made.sheet.panels.push_back({paint(took.after, frame.width, frame.height, *made.sheet.scale),
                               text_of("specialised: %.3g us a ray", after / 1000)});
  made.lines.push_back(
      text_of("mean of a ray: %.4g ns with generic navigators, ", before) +
      text_of("%.4g ns with specialised ones: %.2f times", after, after > 0 ? before / after : 0));
}

}  // namespace

int rows_of(const Request& request) {
  return request.frame.height * (request.mode == Mode::time ? 2 * time_passes + 2 : 1);
}

Made make(const std::shared_ptr<const World>& world, const Request& request) {
  const Visible visible = visible_of(*world, request.show);
  Runtime runtime(world, request.mode == Mode::surface ? quick(request.runtime) : request.runtime);
  Frame frame = request.frame;
  ViewOptions wanted = request.view;
  if (request.slice) {
    const Vec3& n = request.slice->normal;
    wanted.from = n.x != 0 ? "+x" : n.y != 0 ? "+y" : "+z";
  }
  const Extent box = seen_box(runtime, visible, frame.cuts);
  frame.view = view_of(box, *world, wanted, frame.width, frame.height);
  Made made;
  made.width = frame.width;
  made.height = frame.height;
  made.sheet.legend = request.legend;
  std::optional<double> depth;
  if (request.slice) {
    // Way along the view, from where the rays start.
    depth = dot(request.slice->normal, frame.view.eye) - request.slice->offset;
  }
  if (request.mode == Mode::surface) {
    make_surfaces(runtime, visible, frame, request, depth, made);
  } else if (request.mode == Mode::time) {
    make_times(world, frame, request, made);
  } else {
    make_values(runtime, visible, frame, request, made);
  }
  if (!frame.view.perspective) {
    made.sheet.notes.push_back(length_text(2 * frame.view.half_width) + " across");
  }
  if (request.slice) {
    const Vec3& n = request.slice->normal;
    made.sheet.notes.push_back(std::string("at ") +
                               (n.x != 0   ? "x"
                                : n.y != 0 ? "y"
                                           : "z") +
                               text_of(" = %.6g mm", request.slice->offset));
  } else if (!request.view.eye) {
    made.sheet.notes.push_back("from " + request.view.from);
  }
  return made;
}

}  // namespace navjit::picture
