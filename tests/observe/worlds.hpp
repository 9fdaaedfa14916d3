// Small detectors with volumes that nothing observes.
#pragma once

#include <string>
#include <utility>

#include "navjit/builder.hpp"
#include "navjit/observation.hpp"

namespace navjit::tests {

inline const Observation materials_only{.kind = Observation::Kind::materials};

/// A builder with two materials.
struct TwoMaterials {
  DetectorBuilder builder;
  DetectorBuilder::MaterialId air = builder.material({.name = "air", .density = 0.0012});
  DetectorBuilder::MaterialId lead = builder.material({.name = "lead", .density = 11.35});

  VolumeId box(const std::string& name, double half, DetectorBuilder::MaterialId material) {
    return box(name, half, half, half, material);
  }
  VolumeId box(const std::string& name, double hx, double hy, double hz,
               DetectorBuilder::MaterialId material) {
    return builder.volume(name, make_box(name, hx, hy, hz), material);
  }
};

/// A hall of air with a shell of air, in which there is a brick of lead.
struct Shell : TwoMaterials {
  VolumeId hall = box("hall", 100, air);
  VolumeId shell = box("shell", 20, air);
  VolumeId brick = box("brick", 5, lead);

  explicit Shell(const Vec3& brick_at = {1, 2, 3}) {
    builder.place(brick, shell, placed_at(brick_at, {0.3, 0, 0}), 7);
  }
  ObservedDetector observed(const Observation& observation = materials_only) const {
    return ObservedDetector(builder.build(hall), observation);
  }
};

}  // namespace navjit::tests
