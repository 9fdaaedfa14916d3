// What pixels show is compared with steps of a ray through the whole detector, and with locate().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/picture/make.hpp"
#include "common/material_budget.hpp"
#include "geometry/gdml/read_world.hpp"

namespace navjit::picture {
namespace {

constexpr int width = 61, height = 47;

std::shared_ptr<const World> detector(const std::string& name) {
  return std::make_shared<const World>(
      read_world(std::string(NAVJIT_DETECTORS_DIR) + "/" + name + ".gdml"));
}

/// The ray from where it enters the world's box, by the box's planes; nothing if it misses the box.
std::optional<Ray> into_the_box(const World& world, const Ray& ray) {
  const Extent& box = world.volumes[world.top].solid.extent;
  double from = 0, to = 1e300;
  const auto clip = [&](double p, double d, double low, double high) {
    if (d == 0) {
      if (p < low || p > high) to = -1;
      return;
    }
    from = std::max(from, std::min((low - p) / d, (high - p) / d));
    to = std::min(to, std::max((low - p) / d, (high - p) / d));
  };
  clip(ray.position.x, ray.direction.x, box.min.x, box.max.x);
  clip(ray.position.y, ray.direction.y, box.min.y, box.max.y);
  clip(ray.position.z, ray.direction.z, box.min.z, box.max.z);
  if (!(from + 1e-6 < to)) return std::nullopt;
  return Ray{ray.position + (from + 1e-7) * ray.direction, ray.direction};
}

bool is_cut(const std::vector<Cut>& cuts, const Vec3& p) {
  return std::any_of(cuts.begin(), cuts.end(), [&](const Cut& cut) {
    return std::all_of(cut.begin(), cut.end(),
                       [&](const HalfSpace& half) { return dot(half.normal, p) > half.offset; });
  });
}

/// A step of the oracle.
struct Part {
  State state;
  Vec3 from;
  double length;
};

std::vector<Part> parts_of(Navigator& navigator, const World& world, const Ray& ray) {
  std::vector<Part> parts;
  const std::optional<Ray> inner = into_the_box(world, ray);
  if (!inner) return parts;
  Vec3 at = inner->position;
  transport(navigator, *inner, world.tolerance, [&](const State& state, double length) {
    parts.push_back({state, at, length});
    at += length * inner->direction;
  });
  return parts;
}

/// How much of a part the cuts leave, mm: judged by the middles of its pieces between their planes.
double left_by(const std::vector<Cut>& cuts, const Part& part, const Vec3& direction) {
  std::vector<double> ends{0, part.length};
  for (const Cut& cut : cuts) {
    for (const HalfSpace& half : cut) {
      const double at = (half.offset - dot(half.normal, part.from)) / dot(half.normal, direction);
      if (at > 0 && at < part.length) ends.push_back(at);
    }
  }
  std::sort(ends.begin(), ends.end());
  double left = 0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const Vec3 middle = part.from + (0.5 * (ends[i - 1] + ends[i])) * direction;
    left += is_cut(cuts, middle) ? 0 : ends[i] - ends[i - 1];
  }
  return left;
}

struct Case {
  const char *name, *detector, *from;
  std::optional<Vec3> eye{}, at{};
  std::optional<double> fov{};
  const char *cut = nullptr, *other_cut = nullptr;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Pixels : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& c = GetParam();
    for (const char* cut : {c.cut, c.other_cut}) {
      if (cut != nullptr) frame_.cuts.push_back(parse_cut(cut));
    }
    const Extent box = seen_box(runtime_, visible_, frame_.cuts);
    frame_.view = view_of(box, *world_, {.from = c.from, .eye = c.eye, .at = c.at, .fov = c.fov},
                          width, height);
  }
  template <class Check>
  void each_pixel(Check&& check) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        check(static_cast<std::size_t>(y * width + x), frame_.view.ray(x, y, width, height));
      }
    }
  }

  std::shared_ptr<const World> world_ = detector(GetParam().detector);
  Runtime runtime_{world_, {.jit = JitMode::off}};
  Visible visible_ = visible_of(*world_, {});
  Frame frame_{.width = width, .height = height, .threads = 3};
};

TEST_P(Pixels, ShowTheVolumeThatATraceMeetsFirst) {
  const std::vector<Surface> seen = surfaces(runtime_, visible_, frame_);
  Navigator navigator = runtime_.navigator();
  std::size_t something = 0, differences = 0;
  each_pixel([&](std::size_t number, const Ray& ray) {
    VolumeId expected = Surface::nothing;
    for (const Part& part : parts_of(navigator, *world_, ray)) {
      if (!visible_.opaque[part.state.volume()]) continue;
      if (left_by(frame_.cuts, part, ray.direction) == 0) continue;
      expected = part.state.volume();
      break;
    }
    something += expected != Surface::nothing ? 1 : 0;
    differences += seen[number].volume != expected ? 1 : 0;
    EXPECT_GE(seen[number].light, 0.29F);
    EXPECT_LE(seen[number].light, 1.0F);
  });
  EXPECT_GT(something, 100U);
  // Rays along faces, whose starts differ in their last bits, may end on either side.
  EXPECT_LE(differences, 2U);
}

TEST_P(Pixels, HaveTheSumsOfATrace) {
  const std::vector<common::MaterialRates> rates = common::material_rates(*world_);
  const auto path = values(runtime_, visible_, frame_, Quantity::path);
  const auto lengths = values(runtime_, visible_, frame_, Quantity::radiation_lengths);
  const auto mass = values(runtime_, visible_, frame_, Quantity::mass);
  const auto steps = values(runtime_, visible_, frame_, Quantity::steps);
  Navigator navigator = runtime_.navigator();
  std::size_t far = 0, other_steps = 0;
  each_pixel([&](std::size_t number, const Ray& ray) {
    double sums[3] = {0, 0, 0};
    const std::vector<Part> parts = parts_of(navigator, *world_, ray);
    for (const Part& part : parts) {
      const double left = left_by(frame_.cuts, part, ray.direction);
      const VolumeId v = part.state.volume();
      sums[0] += visible_.opaque[v] ? left : 0;
      sums[1] += left * rates[v].radiation_lengths;
      sums[2] += left * rates[v].mass;
    }
    const double made[] = {path[number], lengths[number], mass[number]};
    for (int i = 0; i < 3; ++i) {
      far += std::abs(made[i] - sums[i]) > 1e-9 * sums[i] + 1e-6 ? 1 : 0;
    }
    other_steps += steps[number] != static_cast<double>(parts.size()) ? 1 : 0;
  });
  EXPECT_LE(far, 9U);
  EXPECT_LE(other_steps, 3U);
}

TEST_P(Pixels, AreTheSameForAnyNumberOfThreadsAndWithSpecialisation) {
  const std::vector<Surface> one = surfaces(runtime_, visible_, frame_);
  Runtime specialised(world_,
                      {.jit = JitMode::wait,
                       .specialiser = {.constants = false, .structures = false, .solids = false}});
  Frame frame = frame_;
  frame.threads = 1;
  const std::vector<Surface> other = surfaces(specialised, visible_, frame);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].touchable, other[i].touchable);
    EXPECT_EQ(one[i].light, other[i].light);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Picture, Pixels,
    testing::Values(
        Case{"corner", "barrel", "corner"},
        Case{.name = "quarter", .detector = "barrel", .from = "corner", .cut = "x<0,y>0"},
        Case{.name = "two_cuts",
             .detector = "barrel",
             .from = "+x",
             .cut = "x>10",
             .other_cut = "z>1000"},
        Case{.name = "perspective",
             .detector = "absorber",
             .from = "",
             .eye = Vec3{-4000, 900, -800}},
        Case{.name = "inside",
             .detector = "absorber",
             .from = "",
             .eye = Vec3{0, 0, 10},
             .at = Vec3{300, 20, 400}},
        Case{.name = "along_z", .detector = "shashlik", .from = "-z", .cut = "z<12600"},
        Case{.name = "fov", .detector = "argon", .from = "-x", .fov = 60, .cut = "x<0"}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Slice, ShowsWhatIsLocatedOnThePlane) {
  const auto world = detector("barrel");
  Runtime runtime(world, {.jit = JitMode::off});
  Navigator navigator = runtime.navigator();
  for (const auto& [view, axis, at] :
       {std::tuple{"+x", 0, 12.5}, std::tuple{"+y", 1, -3.0}, std::tuple{"+z", 2, 150.25}}) {
    Frame frame{.width = width, .height = height};
    const Extent& box = world->volumes[world->top].solid.extent;
    frame.view = view_of(box, *world, {.from = view}, width, height);
    const auto coordinate = [axis = axis](const Vec3& p) {
      return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    };
    const Visible all = visible_of(*world, {});
    const auto seen = slice(runtime, all, frame, coordinate(frame.view.eye) - at);
    std::size_t something = 0, differences = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Ray ray = frame.view.ray(x, y, width, height);
        Vec3 p = ray.position;
        (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = at;
        const State state = navigator.locate(p, ray.direction);
        const bool shown = state.inside() && state.volume() != world->top;
        const VolumeId expected = shown ? state.volume() : Surface::nothing;
        something += shown ? 1 : 0;
        differences += seen[static_cast<std::size_t>(y * width + x)].volume != expected ? 1 : 0;
      }
    }
    EXPECT_GT(something, 100U);
    EXPECT_LE(differences, 1U);
  }
}

TEST(Times, AreMeasuredForEachPixel) {
  const auto world = detector("absorber");
  Runtime a(world, {.jit = JitMode::off}), b(world, {.jit = JitMode::off});
  Frame frame{.width = 20, .height = 10, .threads = 2};
  int told = 0;
  frame.progress = [&](int rows) { told = std::max(told, rows); };
  const Extent& box = world->volumes[world->top].solid.extent;
  frame.view = view_of(box, *world, {}, 20, 10);
  const Times took = times(a, b, frame);
  EXPECT_EQ(told, 10 * 2 * time_passes);
  for (const auto* all : {&took.before, &took.after}) {
    ASSERT_EQ(all->size(), 200U);
    for (const double ns : *all) {
      EXPECT_GT(ns, 0);
      EXPECT_TRUE(std::isfinite(ns));
    }
  }
}

TEST(Visible, ChoosesByNames) {
  const auto world = detector("barrel");
  const auto shown = [&](const ShowOptions& options) {
    const Visible visible = visible_of(*world, options);
    std::vector<std::string> names;
    for (std::size_t v = 0; v < world->volumes.size(); ++v) {
      if (visible.opaque[v]) names.push_back(world->volumes[v].name);
    }
    return names;
  };
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto all = shown({});
  EXPECT_TRUE(has(all, "Endcap"));
  EXPECT_FALSE(has(all, world->volumes[world->top].name));
  EXPECT_FALSE(has(shown({.hide = {"End*"}}), "Endcap"));
  EXPECT_TRUE(has(shown({.hide = {"End*"}}), "Hcal"));
  const auto hcal = shown({.only = {"Hcal"}});
  EXPECT_TRUE(has(hcal, "Hcal"));
  EXPECT_FALSE(has(hcal, "Endcap"));
  EXPECT_TRUE(has(hcal, "HcalPlate0"));  // in it
  const std::string top = world->volumes[world->top].name;
  EXPECT_TRUE(has(shown({.show = {top}}), top));
  EXPECT_THROW(shown({.hide = {"NoSuchThing"}}), Error);
  EXPECT_THROW(shown({.only = {"NoSuchThing"}}), Error);
}

}  // namespace
}  // namespace navjit::picture
