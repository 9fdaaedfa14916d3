#include "geometry/gdml/write/frames.hpp"

#include <cmath>

#include "geometry/gdml/write/xml_text.hpp"

namespace navjit::gdml {
namespace {

std::string vector_text(const std::string& tag, const std::string& name, const Vec3& v,
                        const char* unit) {
  return '<' + tag + attribute("name", name) + attributes({{"x", v.x}, {"y", v.y}, {"z", v.z}}) +
         (unit == nullptr ? "" : attribute("unit", unit)) + "/>";
}

std::string frame_text(const std::string& name, const double (&translation)[3],
                       const double (&rotation)[9], bool rotated) {
  std::string text;
  const Vec3 t{translation[0], translation[1], translation[2]};
  if (t.x != 0 || t.y != 0 || t.z != 0) text += vector_text("position", name, t, "mm");
  if (rotated) text += vector_text("rotation", name, angles_of(rotation), "rad");
  return text;
}

double determinant(const double (&r)[9]) {
  return r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
         r[2] * (r[3] * r[7] - r[4] * r[6]);
}

}  // namespace

Vec3 angles_of(const double (&r)[9]) {
  const double x = std::atan2(r[7], r[8]), y = std::atan2(-r[6], std::hypot(r[0], r[3]));
  // If y is a right angle, x may be anything: z is what is left once x is turned back.
  const double s = std::sin(x), c = std::cos(x);
  return {x, y, std::atan2(r[2] * s - r[1] * c, r[4] * c - r[5] * s)};
}

bool mirrors(const Transformation& frame) { return determinant(frame.rotation) < 0; }

Transformation without_mirror(const Transformation& frame) {
  Transformation proper = frame;
  for (int i = 6; i < 9; ++i) proper.rotation[i] = 0 - frame.rotation[i];
  proper.rotated = true;
  return proper;
}

std::string placement_text(const std::string& name, const Transformation& frame) {
  if (!mirrors(frame)) {
    return frame_text(name, frame.translation, frame.rotation, frame.rotated);
  }
  // The reader multiplies the last row by -1.
  const Transformation proper = without_mirror(frame);
  return frame_text(name, frame.translation, proper.rotation, true) +
         vector_text("scale", name, {1, 1, -1}, nullptr);
}

std::string operand_text(const std::string& name, const Transformation& frame) {
  double active[9];
  for (int i = 0; i < 9; ++i) active[i] = frame.rotation[3 * (i % 3) + i / 3];
  return frame_text(name, frame.translation, active, frame.rotated);
}

}  // namespace navjit::gdml
