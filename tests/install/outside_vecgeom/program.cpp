#include <navjit/vecgeom.hpp>

#include <VecGeom/management/GeoManager.h>
#include <VecGeom/volumes/UnplacedBox.h>

#include <cmath>
#include <cstdio>

int main() {
  using Vector = vecgeom::Vector3D<double>;
  vecgeom::UnplacedBox hall_box(100, 100, 100), brick_box(10, 20, 30);
  vecgeom::LogicalVolume hall("hall", &hall_box), brick("brick", &brick_box);
  const vecgeom::Transformation3D at(0, 0, 50);
  hall.PlaceDaughter("brick", &brick, &at);
  vecgeom::GeoManager& manager = vecgeom::GeoManager::Instance();
  manager.SetWorldAndClose(hall.Place());
  navjit::vecgeom::Navigation navigation({.mm_per_unit = 1});
  navigation.attach();
  auto* in = vecgeom::NavigationState::MakeInstance(manager.getMaxDepth());
  auto* out = vecgeom::NavigationState::MakeInstance(manager.getMaxDepth());
  const Vector start(0, 0, -50), along(0, 0, 1);
  navigation.locate(start, along, *in);
  const double length = hall.GetNavigator()->ComputeStepAndPropagatedState(
      start, along, vecgeom::kInfLength, *in, *out);
  const bool ours = hall.GetNavigator() == &navigation.navigator();
  std::printf("%g mm into %s\n", length, out->Top()->GetLogicalVolume()->GetName());
  return ours && std::abs(length - 70) < 1e-9 ? 0 : 1;
}
