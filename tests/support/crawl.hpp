// A detector in which one ray crawls: it makes steps of almost no length, from one solid into
// another at the same place and back.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "geometry/rays/ray.hpp"
#include "navjit/builder.hpp"
#include "navjit/foreign_solid.hpp"

namespace navjit::tests {

/// A cube out of which every way along the x axis is a few tolerances long. Having been asked
/// `patience` times it is an ordinary cube, so that a loop that would never end does end.
class StickyCube : public ForeignSolid {
 public:
  static constexpr double half = 5;
  static constexpr int patience = 200000;

  /// `way` is in mm. Counts in `asked` how often it was asked for such a way.
  StickyCube(double way, std::shared_ptr<std::atomic<int>> asked)
      : way_(way), asked_(std::move(asked)) {}

  PointSide inside(const Vec3& p) const override {
    const double out = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - half;
    if (out > tolerance()) return PointSide::outside;
    return out < -tolerance() ? PointSide::inside : PointSide::surface;
  }
  double distance_to_in(const Vec3& p, const Vec3& v) const override {
    const auto [in, out] = crossings(p, v);
    const bool missed = out <= in || out <= 0;
    return missed ? std::numeric_limits<double>::infinity() : std::max(in, 0.0);
  }
  double distance_to_out(const Vec3& p, const Vec3& v) const override {
    if (v.x == 1 && (*asked_)++ < patience) return way_;
    return std::max(crossings(p, v).second, 0.0);
  }
  double safety_to_in(const Vec3&) const override { return 0; }
  double safety_to_out(const Vec3&) const override { return 0; }
  Vec3 normal(const Vec3&) const override { return {1, 0, 0}; }

 private:
  /// Where a line is in all three slabs. Beside a slab that it is parallel to this is nowhere.
  static std::pair<double, double> crossings(const Vec3& p, const Vec3& v) {
    double in = -1e99, out = 1e99;
    for (const auto& [at, along] : {std::pair{p.x, v.x}, {p.y, v.y}, {p.z, v.z}}) {
      if (along == 0) {
        if (std::abs(at) > half) return {0, -1};
        continue;
      }
      const double side = along > 0 ? half : -half;
      in = std::max(in, (-side - at) / along);
      out = std::min(out, (side - at) / along);
    }
    return {in, out};
  }

  double way_;
  std::shared_ptr<std::atomic<int>> asked_;
};

/// Two such cubes at the same place in a hall of another material, and a block of theirs before
/// them.
struct Crawl {
  std::shared_ptr<std::atomic<int>> asked = std::make_shared<std::atomic<int>>(0);
  Detector detector;
  /// The ray that crawls. It begins in the block, 10 mm before the cubes.
  Ray ray{{-15, 0.1, 0.2}, {1, 0, 0}};

  /// `way` is in tolerances of the detector.
  explicit Crawl(double way) : detector(made(way, asked)) {}

 private:
  static Detector made(double way, const std::shared_ptr<std::atomic<int>>& asked) {
    const double tolerance = built(0, asked).tolerance();
    return built(way * tolerance, asked);
  }
  static Detector built(double way, const std::shared_ptr<std::atomic<int>>& asked) {
    constexpr double half = StickyCube::half;
    DetectorBuilder builder;
    const auto air = builder.material({.name = "air", .density = 0.0012});
    const VolumeId hall = builder.volume("hall", make_box("hall", 100, 100, 100), air);
    const auto lead = builder.material({.name = "lead", .density = 11.35});
    const VolumeId block = builder.volume("block", make_box("block", 10, 5, 5), lead);
    builder.place(block, hall, placed_at({-15, 0, 0}));
    for (const std::string name : {"one", "other"}) {
      const Extent box{{-half, -half, -half}, {half, half, half}};
      const Solid cube = make_foreign(name, std::make_shared<StickyCube>(way, asked), box);
      builder.place(builder.volume(name, cube, lead), hall);
    }
    return builder.build(hall);
  }
};

}  // namespace navjit::tests
