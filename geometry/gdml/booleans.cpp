// Solids made of solids: union, subtraction, intersection.
#include <algorithm>

#include "geometry/gdml/solids.hpp"

namespace navjit::gdml {
namespace {

using Combine = Solid (*)(std::string, const Solid&, const Solid&);

bool is_zero(const Vector& v) { return v == Vector{0, 0, 0}; }

/// The operand where the frame puts it. Booleans place actively, so that the way into the operand
/// is the inverse rotation.
Solid placed(const Solid& solid, const Frame& frame) {
  if (is_zero(frame.position) && is_zero(frame.rotation)) return solid;
  double active[9], inverse[9];
  rotation_from_angles(frame.rotation[0], frame.rotation[1], frame.rotation[2], active);
  for (int i = 0; i < 9; ++i) inverse[i] = active[3 * (i % 3) + i / 3];
  const Transformation t =
      make_transformation({frame.position[0], frame.position[1], frame.position[2]}, inverse);
  SolidFrame solid_frame;
  std::copy(std::begin(t.translation), std::end(t.translation), solid_frame.translation);
  std::copy(std::begin(t.rotation), std::end(t.rotation), solid_frame.rotation);
  return make_placed(solid.name, solid, solid_frame);
}

const NamedSolid& operand(FileContext& file, const XmlElement& boolean, const XmlElement* element,
                          const char* which) {
  if (element == nullptr) {
    fail(boolean, std::string("it has no <") + which + ">; a boolean needs two solids");
  }
  return find_solid(file, *element);
}

NamedSolid read_boolean(FileContext& file, const XmlElement& element, const std::string& name,
                        Combine combine) {
  const XmlElement *first = nullptr, *second = nullptr;
  Frame first_frame, second_frame;
  for (const XmlElement& child : element.children()) {
    if (child.tag == "first") {
      first = &child;
    } else if (child.tag == "second") {
      second = &child;
    } else if (!read_frame(file, child, "first", first_frame) &&
               !read_frame(file, child, "", second_frame)) {
      fail(child, "unknown element in a boolean; remove it");
    }
  }
  const NamedSolid& a = operand(file, element, first, "first");
  const NamedSolid& b = operand(file, element, second, "second");
  NamedSolid result;
  result.depth = 1 + std::max(a.depth, b.depth);
  result.parts = a.parts + b.parts;
  const GdmlLimits& limits = file.session.options.limits;
  if (result.depth > limits.max_solid_depth) {
    fail(element, "booleans are nested more than " + std::to_string(limits.max_solid_depth) +
                      " deep; split the solid, or raise GdmlLimits::max_solid_depth");
  }
  if (result.parts > limits.max_solid_parts) {
    fail(element, "the boolean has more than " + std::to_string(limits.max_solid_parts) +
                      " parts; split the solid, or raise GdmlLimits::max_solid_parts");
  }
  result.solid = combine(name, placed(*a.solid, first_frame), placed(*b.solid, second_frame));
  return result;
}

template <Combine combine>
NamedSolid read_with(FileContext& file, const XmlElement& element, const std::string& name) {
  return read_boolean(file, element, name, combine);
}

constexpr SolidKindReader readers[] = {
    {"subtraction", read_with<make_subtraction>},
    {"union", read_with<make_union>},
    {"intersection", read_with<make_intersection>},
};

}  // namespace

std::span<const SolidKindReader> boolean_readers() { return readers; }

}  // namespace navjit::gdml
