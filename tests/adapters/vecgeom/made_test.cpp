// Volumes made in code: assemblies, scaled shapes, booleans, every shape that has a kernel but
// facets and outlines (Debian's VecGeom asserts in its use of Embree where these are placed), and
// what is refused.
#include <VecGeom/base/Transformation3D.h>
#include <VecGeom/navigation/GlobalLocator.h>
#include <VecGeom/volumes/UnplacedAssembly.h>
#include <VecGeom/volumes/UnplacedBooleanVolume.h>
#include <VecGeom/volumes/UnplacedBox.h>
#include <VecGeom/volumes/UnplacedCoaxialCones.h>
#include <VecGeom/volumes/UnplacedCone.h>
#include <VecGeom/volumes/UnplacedCutTube.h>
#include <VecGeom/volumes/UnplacedEllipsoid.h>
#include <VecGeom/volumes/UnplacedEllipticalCone.h>
#include <VecGeom/volumes/UnplacedEllipticalTube.h>
#include <VecGeom/volumes/UnplacedGenTrap.h>
#include <VecGeom/volumes/UnplacedGenericPolycone.h>
#include <VecGeom/volumes/UnplacedHype.h>
#include <VecGeom/volumes/UnplacedMultiUnion.h>
#include <VecGeom/volumes/UnplacedOrb.h>
#include <VecGeom/volumes/UnplacedParaboloid.h>
#include <VecGeom/volumes/UnplacedParallelepiped.h>
#include <VecGeom/volumes/UnplacedPolycone.h>
#include <VecGeom/volumes/UnplacedPolyhedron.h>
#include <VecGeom/volumes/UnplacedSExtruVolume.h>
#include <VecGeom/volumes/UnplacedScaledShape.h>
#include <VecGeom/volumes/UnplacedSphere.h>
#include <VecGeom/volumes/UnplacedTet.h>
#include <VecGeom/volumes/UnplacedTorus2.h>
#include <VecGeom/volumes/UnplacedTrapezoid.h>
#include <VecGeom/volumes/UnplacedTrd.h>
#include <VecGeom/volumes/UnplacedTube.h>

#include <optional>
#include <random>

#include "tests/adapters/vecgeom/states.hpp"
#include "tests/adapters/vecgeom/worlds.hpp"

namespace navjit {
namespace {

using tests::OwnedState;
using ::vecgeom::GeoManager;
using ::vecgeom::LogicalVolume;
using ::vecgeom::NavigationState;
using ::vecgeom::Transformation3D;
using ::vecgeom::UnplacedBox;
using ::vecgeom::VUnplacedVolume;
using Vector = ::vecgeom::Vector3D<double>;

/// A world of VecGeom's, made in code; VecGeom's manager owns everything in it.
class VecGeomMade : public ::testing::Test {
 protected:
  static LogicalVolume& volume(const char* name, const VUnplacedVolume* shape) {
    return *new LogicalVolume(name, shape);
  }
  static void place(LogicalVolume& daughter, LogicalVolume& mother, const Transformation3D& where) {
    mother.PlaceDaughter(daughter.GetName(), &daughter, new Transformation3D(where));
  }
  static void close(LogicalVolume& world) {
    ASSERT_FALSE(std::exchange(tests::has_world(), true)) << "one world a process";
    const tests::Quiet quiet;
    GeoManager::Instance().SetWorldAndClose(world.Place());
  }
  static vecgeom::Options options() { return {.mm_per_unit = 1, .runtime = {.jit = JitMode::off}}; }

  /// Of random points in the world, those that VecGeom finds in another volume.
  static int located_elsewhere(const vecgeom::Navigation& navigation, double half, int points) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> in(-half, half);
    OwnedState its, ours;
    int elsewhere = 0;
    for (int i = 0; i < points; ++i) {
      const Vector point(in(random), in(random), in(random));
      its->Clear();
      ::vecgeom::GlobalLocator::LocateGlobalPoint(GeoManager::Instance().GetWorld(), point, *its,
                                                  true);
      EXPECT_TRUE(navigation.locate(point, {0, 0, 1}, *ours));
      if (its->HasSamePathAsOther(*ours)) continue;
      ++elsewhere;
      if (elsewhere < 5) {
        ADD_FAILURE() << "(" << point.x() << ", " << point.y() << ", " << point.z()
                      << "): " << ours->Top()->GetLabel()
                      << ", VecGeom: " << its->Top()->GetLabel();
      }
    }
    return elsewhere;
  }
};

TEST_F(VecGeomMade, EveryShapeHoldsThePointsThatVecGeomsDoes) {
  namespace vg = ::vecgeom;
  const double z[] = {-8, -2, 3, 8}, rmin[] = {1, 2, 2, 0}, rmax[] = {6, 8, 5, 7};
  double x[] = {-6, 7, 6, -1, -7}, y[] = {-7, -5, 6, 2, 7};
  const double corners_x[] = {-7, -6, 6, 7, -5, -4, 5, 4},
               corners_y[] = {-6, 5, 6, -7, -4, 3, 5, -5};
  using vg::GeoManager;
  const VUnplacedVolume* const tube =
      GeoManager::MakeInstance<vg::UnplacedTube>(2., 7., 8., 0.3, 4.5);
  const VUnplacedVolume* const box = GeoManager::MakeInstance<UnplacedBox>(5., 6., 7.);
  const Transformation3D turned(2, -1, 3, 30, 50, 70);
  const auto operand = [&](const VUnplacedVolume* shape, const Transformation3D& where) {
    return volume("operand", shape).Place(new Transformation3D(where));
  };
  // VecGeom does not notice a reflection by its flags.
  Transformation3D mirrored(1, 2, -1, 20, 40, 60);
  mirrored.ApplyScale(1, 1, -1);
  Transformation3D upside_down;
  upside_down.ApplyScale(1, 1, -1);
  const double r_around[] = {2, 7, 5, 7, 3, 3}, z_around[] = {-7, -7, 0, 7, 7, 0};
  vg::UnplacedTrd* const wedge = GeoManager::MakeInstance<vg::UnplacedTrd>(2., 6., 3., 5., 6.);
  auto* const several = new vg::UnplacedMultiUnion();
  several->AddNode(wedge, upside_down);
  several->AddNode(GeoManager::MakeInstance<vg::UnplacedOrb>(4.), Transformation3D(3, 3, 2));
  several->Close();
  // A whole torus, and less than half a turn of the polyhedron: VecGeom 1.2.1 takes points beyond
  // the ends of a torus segment for inside (r 5.52, phi 4.534, z -1.796 of one from 0.3 to 2.3),
  // and points at the first and last sides of a polyhedron of more than half a turn for outside.
  const std::vector<std::pair<const char*, const VUnplacedVolume*>> shapes{
      {"box", box},
      {"tube", tube},
      {"whole tube", GeoManager::MakeInstance<vg::UnplacedTube>(0., 7., 8., 0., vg::kTwoPi)},
      {"cone", GeoManager::MakeInstance<vg::UnplacedCone>(1., 4., 2., 8., 7., 0.5, 4.)},
      {"trd", GeoManager::MakeInstance<vg::UnplacedTrd>(3., 7., 4., 6., 8.)},
      {"trap", GeoManager::MakeInstance<vg::UnplacedTrapezoid>(7., 0.1, 0.2, 4., 3., 5., 0.1, 5.,
                                                               4., 6., 0.1)},
      {"para", GeoManager::MakeInstance<vg::UnplacedParallelepiped>(4., 5., 6., 0.3, 0.2, 0.4)},
      {"tet", new vg::UnplacedTet(Vector(7, 7, 7), Vector(-7, -7, 7), Vector(-7, 7, -7),
                                  Vector(7, -7, -7))},
      {"orb", GeoManager::MakeInstance<vg::UnplacedOrb>(8.)},
      {"sphere", GeoManager::MakeInstance<vg::UnplacedSphere>(3., 8., 0.3, 4., 0.4, 2.)},
      {"torus", new vg::UnplacedTorus2(1., 3., 6., 0., vg::kTwoPi)},
      {"polycone",
       GeoManager::MakeInstance<vg::UnplacedPolycone>(0.3, 4., 4, z + 0, rmin + 0, rmax + 0)},
      {"polyhedron", new vg::UnplacedPolyhedron(0.3, 2., 5, 4, z, rmin, rmax)},
      {"cut tube", new vg::UnplacedCutTube(1., 6., 6., 0.3, 4., Vector(0.2, 0.1, -1).Normalized(),
                                           Vector(-0.1, 0.2, 1).Normalized())},
      {"ellipsoid", new vg::UnplacedEllipsoid(6., 7., 8., -5., 6.)},
      {"generic polycone", new vg::UnplacedGenericPolycone(0.3, 4., 6, r_around + 0, z_around + 0)},
      {"multi-union", several},
      {"reflected operand", new vg::UnplacedBooleanVolume<vg::kUnion>(
                                vg::kUnion, operand(wedge, upside_down), operand(tube, mirrored))},
      {"narrowing paraboloid", new vg::UnplacedParaboloid(7., 3., 6.)},
      {"elliptical tube", new vg::UnplacedEllipticalTube(5., 7., 8.)},
      {"elliptical cone", new vg::UnplacedEllipticalCone(0.4, 0.5, 12., 6.)},
      {"paraboloid", new vg::UnplacedParaboloid(3., 8., 7.)},
      {"hype", GeoManager::MakeInstance<vg::UnplacedHype>(2., 4., 0.2, 0.4, 7.)},
      {"arb8", new vg::UnplacedGenTrap(corners_x, corners_y, 7.)},
      {"extruded", new vg::UnplacedSExtruVolume(5, x, y, -6., 7.)},
      {"scaled", new vg::UnplacedScaledShape(tube, 0.9, -0.7, 0.8)},
      {"union", new vg::UnplacedBooleanVolume<vg::kUnion>(vg::kUnion, operand(box, {}),
                                                          operand(tube, turned))},
      {"intersection", new vg::UnplacedBooleanVolume<vg::kIntersection>(
                           vg::kIntersection, operand(box, turned), operand(tube, {}))},
      {"subtraction", new vg::UnplacedBooleanVolume<vg::kSubtraction>(
                          vg::kSubtraction, operand(box, {}), operand(tube, turned))},
  };
  LogicalVolume& world = volume("world", GeoManager::MakeInstance<UnplacedBox>(80., 80., 80.));
  int n = 0;
  for (const auto& [name, shape] : shapes) {
    place(volume(name, shape), world,
          Transformation3D(-60 + 30 * (n % 5), -60 + 30 * (n / 5 % 5), n % 7 + 40 * (n / 25),
                           20 * n, 15 * n, 7 * n));
    ++n;
  }
  close(world);
  const vecgeom::Navigation navigation{options()};
  EXPECT_EQ(navigation.detector().volumes(), shapes.size() + 1);
  // Beside the whole world, points near each shape.
  EXPECT_EQ(located_elsewhere(navigation, 79, 400000), 0);
}

TEST_F(VecGeomMade, AssembliesAreLevelsOfPathsAndOfNoTouchables) {
  const auto* box = GeoManager::MakeInstance<UnplacedBox>(1., 1., 1.);
  LogicalVolume& brick = volume("brick", box);
  LogicalVolume& core = volume("core", GeoManager::MakeInstance<UnplacedBox>(0.5, 0.5, 0.5));
  place(core, brick, Transformation3D(0.2, 0, 0));
  auto* inner_shape = new ::vecgeom::UnplacedAssembly();
  LogicalVolume& inner = volume("inner", inner_shape);
  place(brick, inner, Transformation3D(-2, 0, 0));
  place(brick, inner, Transformation3D(2, 0, 0, 10, 20, 30));
  auto* outer_shape = new ::vecgeom::UnplacedAssembly();
  LogicalVolume& outer = volume("outer", outer_shape);
  place(inner, outer, Transformation3D(0, 3, 0));
  place(brick, outer, Transformation3D(0, 0, 0));
  place(inner, outer, Transformation3D(0, -3, 0, 40, 0, 0));
  LogicalVolume& world = volume("world", GeoManager::MakeInstance<UnplacedBox>(20., 20., 20.));
  place(brick, world, Transformation3D(0, 0, -15));
  place(outer, world, Transformation3D(5, 0, 0));
  place(inner, world, Transformation3D(-8, 0, 0, 0, 90, 0));
  place(outer, world, Transformation3D(0, 0, 10, 30, 30, 30));
  close(world);

  vecgeom::Navigation navigation{options()};
  const Detector& detector = navigation.detector();
  EXPECT_EQ(detector.volumes(), 3U);
  EXPECT_EQ(detector.touchables(), 1U + 2 * (1 + 5 + 2 + 5));
  EXPECT_EQ(located_elsewhere(navigation, 19, 100000), 0);

  // Every touchable's path leads back; then rays, beside navjit directly.
  OwnedState in, out, right;
  for (VolumeId v = 0; v < detector.volumes(); ++v) {
    EXPECT_EQ(detector.volume(v).user_data, reinterpret_cast<std::uint64_t>(v == 0   ? &world
                                                                            : v == 1 ? &brick
                                                                                     : &core));
  }
  Runtime runtime{detector, {.jit = JitMode::off}};
  Navigator direct = runtime.navigator();
  tests::StateMaker maker{detector, direct, 5};
  navigation.attach();
  EXPECT_EQ(brick.GetNavigator(), &navigation.navigator());
  EXPECT_NE(outer.GetNavigator(), &navigation.navigator());
  int through = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto made = maker.make(static_cast<VolumeId>(i % 3));
    if (!made) continue;
    State state = made->state;
    Vec3 point = made->point;
    const Vector direction(made->direction.x, made->direction.y, made->direction.z);
    navigation.write(state, *in);
    while (state.inside()) {
      ASSERT_EQ(navigation.state(*in), state);
      const Step step = direct.step(state, point, made->direction);
      const Vector at(point.x, point.y, point.z);
      const auto* navigator = in->Top()->GetLogicalVolume()->GetNavigator();
      // The daughter that is hit, with the assemblies that it is in.
      ASSERT_EQ(navigator->ComputeStep(at, direction, 1e30, *in, *out), step.length);
      const int hit = out->GetCurrentLevel();
      ASSERT_EQ(navigator->ComputeStepAndPropagatedState(at, direction, 1e30, *in, *out),
                step.length);
      navigation.write(step.next, *right);
      ASSERT_TRUE(out->HasSamePathAsOther(*right));
      ASSERT_EQ(navigation.state(*out), step.next);
      if (hit > in->GetCurrentLevel()) {
        ASSERT_GE(out->GetCurrentLevel(), hit);
      }
      if (!out->IsOutside()) {
        ASSERT_FALSE(out->Top()->IsAssembly());
        through += out->GetCurrentLevel() >= 4 ? 1 : 0;
      }
      point += step.length * made->direction;
      state = step.next;
      out->CopyTo(&*in);
    }
  }
  EXPECT_GT(through, 100);
}

TEST_F(VecGeomMade, AShapeWithoutAKernelIsRefusedWithItsVolume) {
  LogicalVolume& world = volume("world", GeoManager::MakeInstance<UnplacedBox>(20., 20., 20.));
  double rmin1[] = {1, 3}, rmax1[] = {2, 4}, rmin2[] = {1, 3}, rmax2[] = {2, 4};
  place(volume("coils", new ::vecgeom::UnplacedCoaxialCones(2, rmin1, rmax1, rmin2, rmax2, 5., 0.,
                                                            ::vecgeom::kTwoPi)),
        world, Transformation3D(1, 2, 3));
  const auto* before = world.GetNavigator();
  close(world);
  try {
    const vecgeom::Navigation navigation{options()};
    FAIL() << "not refused";
  } catch (const GeometryError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("'coils'"), std::string::npos) << text;
    EXPECT_NE(text.find("UnplacedCoaxialCones"), std::string::npos) << text;
  }
  EXPECT_EQ(world.GetNavigator(), before);
}

TEST_F(VecGeomMade, AWorldThatIsNotThereIsRefused) {
  EXPECT_THROW(vecgeom::Navigation{options()}, UsageError);
}

TEST_F(VecGeomMade, WhatHoldsNoPointIsLeftOut) {
  namespace vg = ::vecgeom;
  const auto* box = GeoManager::MakeInstance<UnplacedBox>(1., 1., 1.);
  const auto apart = [&] {
    return new vg::UnplacedBooleanVolume<vg::kIntersection>(
        vg::kIntersection, volume("a", box).Place(new Transformation3D(-3, 0, 0)),
        volume("b", box).Place(new Transformation3D(3, 0, 0)));
  };
  LogicalVolume& world = volume("world", GeoManager::MakeInstance<UnplacedBox>(20., 20., 20.));
  LogicalVolume& nothing = volume("nothing", apart());
  place(volume("in nothing", box), nothing, {});
  place(nothing, world, Transformation3D(5, 0, 0));
  place(volume("brick", box), world, Transformation3D(-5, 0, 0));
  // A union with nothing is the other operand.
  place(volume("rest", new vg::UnplacedBooleanVolume<vg::kUnion>(
                           vg::kUnion, volume("c", apart()).Place(), volume("d", box).Place())),
        world, Transformation3D(0, 5, 0));
  close(world);
  const vecgeom::Navigation navigation{options()};
  EXPECT_EQ(navigation.detector().volumes(), 3U);
  EXPECT_EQ(navigation.empty_volumes(), std::vector<std::string>{"nothing"});
  EXPECT_FALSE(navigation.volume(nothing));
  EXPECT_EQ(located_elsewhere(navigation, 19, 50000), 0);
}

TEST_F(VecGeomMade, MaterialsAndRoomAndAttachingAreTheUsers) {
  LogicalVolume& world = volume("world", GeoManager::MakeInstance<UnplacedBox>(20., 20., 20.));
  LogicalVolume& brick = volume("brick", GeoManager::MakeInstance<UnplacedBox>(1., 1., 1.));
  LogicalVolume& other = volume("other", GeoManager::MakeInstance<UnplacedBox>(1., 1., 1.));
  place(brick, world, Transformation3D(3, 0, 0));
  close(world);
  vecgeom::Options with = options();
  with.material = [](DetectorBuilder& builder, const LogicalVolume& of) {
    return builder.material({.name = "of " + of.GetLabel(), .density = 2});
  };
  const auto* had = brick.GetNavigator();
  const auto* had_safety = brick.GetSafetyEstimator();
  {
    vecgeom::Navigation navigation{with};
    const Detector& detector = navigation.detector();
    EXPECT_EQ(detector.material(detector.volume(*navigation.volume(brick))).name, "of brick");

    const LogicalVolume* hot[] = {&brick};
    navigation.attach(hot);
    navigation.attach(hot);
    EXPECT_EQ(brick.GetNavigator(), &navigation.navigator());
    EXPECT_EQ(brick.GetSafetyEstimator(), &navigation.safety_estimator());
    EXPECT_NE(world.GetNavigator(), &navigation.navigator());
    const LogicalVolume* strange[] = {&world, &other};
    EXPECT_THROW(navigation.attach(strange), UsageError);
    EXPECT_NE(world.GetNavigator(), &navigation.navigator());

    // A state with room for one level, and one from outside.
    NavigationState* small = NavigationState::MakeInstance(0);
    EXPECT_THROW(navigation.locate({3, 0, 0}, {0, 0, 1}, *small), UsageError);
    EXPECT_TRUE(navigation.locate({-3, 0, 0}, {0, 0, 1}, *small));
    OwnedState in, out;
    EXPECT_FALSE(navigation.locate({300, 0, 0}, {0, 0, 1}, *in));
    EXPECT_TRUE(in->IsOutside());
    const auto step = [&](const NavigationState& from, NavigationState& to, const Vector& along) {
      return navigation.navigator().ComputeStepAndPropagatedState({-3, 0, 0}, along, 1e30, from,
                                                                  to);
    };
    EXPECT_THROW(step(*in, *out, {0, 0, 1}), UsageError);
    EXPECT_TRUE(navigation.locate({-3, 0, 0}, {0, 0, 1}, *in));
    EXPECT_THROW(step(*in, *out, {0, 0, 2}), UsageError);
    EXPECT_THROW(step(*in, *small, {1, 0, 0}), UsageError);
    // A path that begins below the world.
    in->Clear();
    in->Push(world.GetDaughters()[0]);
    EXPECT_THROW(step(*in, *out, {1, 0, 0}), UsageError);
    EXPECT_TRUE(navigation.locate({-3, 0, 0}, {0, 0, 1}, *in));
    EXPECT_EQ(step(*in, *out, {1, 0, 0}), 5);
    EXPECT_EQ(out->Top()->GetLogicalVolume(), &brick);
    NavigationState::ReleaseInstance(small);
    // What has no state is asked of what the volume had.
    EXPECT_EQ(
        navigation.safety_estimator().ComputeSafetyForLocalPoint(Vector(0.5, 0, 0), out->Top()),
        had_safety->ComputeSafetyForLocalPoint(Vector(0.5, 0, 0), out->Top()));
  }
  EXPECT_EQ(brick.GetNavigator(), had);
  EXPECT_EQ(brick.GetSafetyEstimator(), had_safety);
}

TEST_F(VecGeomMade, SeveralAreAttachedAndDetachedInAnyOrder) {
  LogicalVolume& world = volume("world", GeoManager::MakeInstance<UnplacedBox>(20., 20., 20.));
  LogicalVolume& brick = volume("brick", GeoManager::MakeInstance<UnplacedBox>(1., 1., 1.));
  place(brick, world, Transformation3D(3, 0, 0));
  close(world);
  const auto* had = brick.GetNavigator();
  const auto* had_safety = brick.GetSafetyEstimator();
  const ::vecgeom::VPlacedVolume* placed = world.GetDaughters()[0];
  const double safety = had_safety->ComputeSafetyForLocalPoint(Vector(0.5, 0, 0), placed);
  const auto expect = [&](const ::vecgeom::VNavigator* navigator) {
    EXPECT_EQ(brick.GetNavigator(), navigator);
    EXPECT_EQ(brick.GetSafetyEstimator()->ComputeSafetyForLocalPoint(Vector(0.5, 0, 0), placed),
              safety);
  };
  std::optional<vecgeom::Navigation> one(options()), two(options());
  for (vecgeom::Navigation* n : {&*one, &*two, &*one}) {
    n->attach();
    expect(&n->navigator());
  }
  one->detach();
  expect(had);
  for (vecgeom::Navigation* n : {&*two, &*one, &*two, &*one, &*two}) n->attach();
  one.reset();
  expect(&two->navigator());
  two->detach();
  expect(had);
  one.emplace(options());
  one->attach();
  two->attach();
  one->detach();
  expect(&two->navigator());
  two.reset();
  expect(had);
  EXPECT_EQ(brick.GetSafetyEstimator(), had_safety);
  EXPECT_EQ(world.GetNavigator(), had);
}

}  // namespace
}  // namespace navjit
