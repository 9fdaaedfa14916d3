// Solids of Geant4 that navjit has no kernel for: Geant4 is asked for their answers.
#include <G4AffineTransform.hh>
#include <G4GeometryTolerance.hh>
#include <G4VoxelLimits.hh>
#include <cmath>

#include "adapters/geant4/solids.hpp"
#include "adapters/geant4/vector.hpp"
#include "navjit/foreign_solid.hpp"
#include "navjit/geant4/geometry.hpp"

namespace navjit::geant4 {
namespace {

/// A distance with Geant4's infinity, or what is near it, replaced by navjit's.
double distance(G4double given) {
  return given >= kInfinity / 2 ? std::numeric_limits<double>::infinity() : given;
}

/// Does not own the solid; Geant4's stores own it.
class Geant4Solid : public ForeignSolid {
 public:
  explicit Geant4Solid(const G4VSolid& solid)
      : solid_(&solid), tolerance_(G4GeometryTolerance::GetInstance()->GetSurfaceTolerance()) {}

  PointSide inside(const Vec3& p) const override {
    switch (solid_->Inside(vector(p))) {
      case kInside:
        return PointSide::inside;
      case kSurface:
        return PointSide::surface;
      default:
        return PointSide::outside;
    }
  }
  double distance_to_in(const Vec3& p, const Vec3& direction) const override {
    return distance(solid_->DistanceToIn(vector(p), vector(direction)));
  }
  double distance_to_out(const Vec3& p, const Vec3& direction) const override {
    return distance(solid_->DistanceToOut(vector(p), vector(direction)));
  }
  double safety_to_in(const Vec3& p) const override { return solid_->DistanceToIn(vector(p)); }
  double safety_to_out(const Vec3& p) const override { return solid_->DistanceToOut(vector(p)); }
  Vec3 normal(const Vec3& p) const override {
    const G4ThreeVector n = solid_->SurfaceNormal(vector(p));
    return {n.x(), n.y(), n.z()};
  }
  double tolerance() const override { return tolerance_; }
  std::string key() const override { return text_of(*solid_); }

 private:
  const G4VSolid* solid_;
  double tolerance_;
};

/// The extent from what every solid can tell; many do not override BoundingLimits().
Extent extent_of(const G4VSolid& solid) {
  const G4VoxelLimits unlimited;
  const G4AffineTransform unmoved;
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    if (!solid.CalculateExtent(static_cast<EAxis>(kXAxis + axis), unlimited, unmoved, low[axis],
                               high[axis]) ||
        !(std::abs(low[axis]) < kInfinity / 2) || !(std::abs(high[axis]) < kInfinity / 2)) {
      throw Unsupported("solid '" + solid.GetName() + "': its class " + solid.GetEntityType() +
                        " does not say how large it is (CalculateExtent)");
    }
    // Boxes may end on the surface: the margin takes in what is on it by Geant4's tolerance.
    const double margin = 1e-6 + 1e-9 * std::max(std::abs(low[axis]), std::abs(high[axis]));
    low[axis] -= margin;
    high[axis] += margin;
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

}  // namespace

Solid convert_foreign(const G4VSolid& solid) {
  return make_foreign(solid.GetName(), std::make_shared<Geant4Solid>(solid), extent_of(solid));
}

}  // namespace navjit::geant4
