// Writes the GDML of the extremes' scenes, with plain numbers in full precision, which VecGeom's
// reader can read, too.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::extremes {

using Attributes = std::initializer_list<std::pair<const char*, double>>;

/// A detector under construction: one world, volumes in it, and volumes in those.
class SceneText {
 public:
  /// An element of <solids>, called `name`; `inner` is written within.
  void solid(const char* tag, const std::string& name, const Attributes& attributes,
             const std::string& inner = "");
  /// An element of <solids> as it is to be written.
  void raw_solid(const std::string& text) { solids_ += text; }
  /// A named point for solids that are given by corners, mm.
  void corner(const std::string& name, const Vec3& p);
  /// A volume of the solid of the same name; to be asked for after its daughters were placed.
  void volume(const std::string& name);
  /// Places a volume in another, turned by the angles as GDML means them (rad).
  void place(const std::string& mother, const std::string& daughter, const Vec3& at,
             const Vec3& angles = {0, 0, 0});
  /// The file; `world` is the volume at the top.
  std::string finished(const std::string& world) const;

  static std::string list(const Attributes& attributes);
  static std::string vector(const char* tag, const std::string& name, const Vec3& v,
                            const char* unit);

 private:
  std::string define_, solids_, structure_;
  std::vector<std::pair<std::string, std::string>> placements_;  ///< by mother
  int placed_ = 0;
};

/// A solid of about 10 mm times `scale` around its origin; all of it is within 16 mm times `scale`.
struct SampleSolid {
  const char* kind;
  bool for_vecgeom;  ///< whether VecGeom 1.2's reader takes it
  void (*write)(SceneText& scene, const std::string& name, double scale);
};
/// One of every kind that GDML has.
const std::vector<SampleSolid>& sample_solids();

/// All samples (or those for VecGeom) in a grid around `centre`, every second one turned.
std::string every_solid(double scale, bool for_vecgeom, const Vec3& centre = {0, 0, 0});

}  // namespace navjit::extremes
