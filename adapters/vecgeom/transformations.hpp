// Converts VecGeom's transformations to navjit's.
#pragma once

#include <VecGeom/base/Transformation3D.h>

#include <algorithm>
#include <iterator>

#include "navjit/solids.hpp"
#include "navjit/transformation.hpp"

namespace navjit::vecgeom {

/// From the mother's frame into the daughter's. VecGeom stores the rotation by columns.
inline SolidFrame frame_of(const ::vecgeom::Transformation3D& from, double mm) {
  SolidFrame frame;
  for (int i = 0; i < 3; ++i) {
    frame.translation[i] = mm * from.Translation(i);
    for (int j = 0; j < 3; ++j) frame.rotation[3 * i + j] = from.Rotation(3 * j + i);
  }
  return frame;
}

inline bool is_identity(const SolidFrame& frame) {
  const SolidFrame none;
  return std::equal(std::begin(frame.rotation), std::end(frame.rotation),
                    std::begin(none.rotation)) &&
         std::equal(std::begin(frame.translation), std::end(frame.translation),
                    std::begin(none.translation));
}

/// The same for placements. Throws GeometryError if the rotation is not orthonormal.
inline Transformation transformation_of(const ::vecgeom::Transformation3D& from, double mm) {
  const SolidFrame frame = frame_of(from, mm);
  return make_transformation(frame.translation, frame.rotation);
}

}  // namespace navjit::vecgeom
