// ROOT's matrices, and the slices of divided volumes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/root/reading.hpp"

namespace navjit::root {
namespace {

constexpr double degree = std::numbers::pi / 180;

void move(Frame& frame, const Object& matrix) {
  const std::span<const double> t = matrix.numbers("fTranslation", 3);
  for (std::size_t i = 0; i < 3; ++i) frame.translation[i] = cm * t[i];
}

void turn(Frame& frame, const Object& matrix) {
  std::ranges::copy(matrix.numbers("fRotationMatrix", 9).first(9), frame.rotation);
}

/// Scales by three numbers; -1 is a reflection.
void scale(Frame& frame, const Object& matrix) {
  const std::span<const double> factors = matrix.numbers("fScale", 3);
  for (std::size_t i = 0; i < 9; ++i) {
    if (std::abs(std::abs(factors[i % 3]) - 1) > 1e-9) {
      matrix.fail("it changes lengths; scale the shape instead (TGeoScaledShape)");
    }
    if (factors[i % 3] < 0) frame.rotation[i] = -frame.rotation[i];
  }
}

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Makes the rows unit vectors at right angles to one another. Matrices from angles that were
/// written with few digits are orthonormal only roughly.
void make_orthonormal(Reading& reading, const Object& matrix, double (&r)[9]) {
  double error = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      error = std::max(error, std::abs(dot(r + 3 * i, r + 3 * j) - (i == j ? 1 : 0)));
    }
  }
  constexpr double fine = 1e-9, rough = 1e-2;
  if (error <= fine) return;
  if (!(error <= rough)) matrix.fail("it is no rotation; angles of 90 degrees become others by it");
  reading.notes.count("made matrices orthonormal that were so only roughly");
  for (int i = 0; i < 3; ++i) {
    double* row = r + 3 * i;
    for (int j = 0; j < i; ++j) {
      const double along = dot(row, r + 3 * j);
      for (int k = 0; k < 3; ++k) row[k] -= along * r[3 * j + k];
    }
    const double length = std::sqrt(dot(row, row));
    for (int k = 0; k < 3; ++k) row[k] /= length;
  }
}

/// How far the line through the middles of a parallelepiped or trap leans for each length along z.
struct Lean {
  double x, y;
};
Lean lean_of(const Object& shape) {
  const double theta = shape.number("fTheta") * degree, phi = shape.number("fPhi") * degree;
  return {std::tan(theta) * std::cos(phi), std::tan(theta) * std::sin(phi)};
}

}  // namespace

Frame read_frame(Reading& reading, Reference reference) {
  Frame frame;
  if (reference == 0) return frame;
  const Object& matrix = reading.objects.at(reference);
  if (matrix.is("TGeoIdentity")) return frame;
  if (matrix.is("TGeoTranslation")) {
    move(frame, matrix);
  } else if (matrix.is("TGeoRotation")) {
    turn(frame, matrix);
  } else if (matrix.is("TGeoCombiTrans") || matrix.is("TGeoGenTrans")) {
    move(frame, matrix);
    if (const Reference rotation = matrix.reference("fRotation")) {
      turn(frame, reading.objects.at(rotation));
    }
  } else if (matrix.is("TGeoHMatrix")) {
    move(frame, matrix);
    turn(frame, matrix);
  } else if (matrix.is("TGeoScale")) {
    scale(frame, matrix);
  } else {
    matrix.fail("unsupported kind of matrix; use TGeoHMatrix");
  }
  make_orthonormal(reading, matrix, frame.rotation);
  return frame;
}

Frame read_slice(Reading& reading, const Object& node, Reference shape_reference) {
  const Object& finder = reading.objects.at(node.reference("fFinder"));
  const double at =
      finder.number("fStart") + (node.number("fIndex") + 0.5) * finder.number("fStep");
  constexpr std::uint32_t reflected = 1U << 14;
  const double sign = (finder.bits & reflected) != 0 ? -1 : 1;
  Frame frame;
  double* t = frame.translation;
  const auto shape = [&]() -> const Object& {
    if (sign < 0) finder.fail("unsupported division of a reflected volume");
    return reading.objects.at(shape_reference);
  };
  if (finder.is("TGeoPatternX") || finder.is("TGeoPatternParaX")) {
    t[0] = cm * at;
  } else if (finder.is("TGeoPatternY")) {
    t[1] = cm * at;
  } else if (finder.is("TGeoPatternZ")) {
    t[2] = sign * cm * at;
  } else if (finder.is("TGeoPatternParaY")) {
    t[0] = cm * at * std::tan(shape().number("fAlpha") * degree);
    t[1] = cm * at;
  } else if (finder.is("TGeoPatternParaZ") || finder.is("TGeoPatternTrapZ")) {
    const Lean lean = lean_of(shape());
    t[0] = cm * at * lean.x;
    t[1] = cm * at * lean.y;
    t[2] = cm * at;
  } else if (finder.is("TGeoPatternCylPhi")) {
    const double phi = at * degree;
    const double turned[9] = {
        std::cos(phi), -std::sin(phi), 0, std::sin(phi), std::cos(phi), 0, 0, 0, 1};
    std::ranges::copy(turned, frame.rotation);
  } else if (!finder.is("TGeoPatternCylR")) {
    finder.fail("unsupported kind of division; place the slices one by one");
  }
  return frame;
}

Transformation transformation_of(const Frame& frame) {
  const double* r = frame.rotation;
  return make_transformation({frame.translation[0], frame.translation[1], frame.translation[2]},
                             {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]});
}

}  // namespace navjit::root
