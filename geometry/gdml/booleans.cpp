// Solids made of solids: union, subtraction, intersection, multiUnion, and scaled solids.
#include <algorithm>

#include "geometry/gdml/solids.hpp"

namespace navjit::gdml {
namespace {

using Combine = Solid (*)(std::string, const Solid&, const Solid&);

bool is_zero(const Vector& v) { return v == Vector{0, 0, 0}; }

bool is_moved(const Frame& frame) { return !is_zero(frame.position) || !is_zero(frame.rotation); }

/// The operand where the frame puts it. Booleans place actively, so that the rotation into the
/// operand's frame is the inverse one.
Solid placed(const Solid& solid, const Frame& frame) {
  if (!is_moved(frame)) return solid;
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

void check_size(FileContext& file, const XmlElement& element, const BooleanSize& size) {
  const GdmlLimits& limits = file.session.options.limits;
  const std::string problem = excess(size,
                                     {limits.max_solid_depth, limits.max_solid_chain,
                                      limits.max_solid_parts, "GdmlLimits", "use a multiUnion"},
                                     file.session.boolean_parts);
  if (!problem.empty()) refuse(element, problem);
}

NamedSolid read_boolean(FileContext& file, const XmlElement& element, const std::string& name,
                        Combine combine, Boolean kind) {
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
  result.size = size_of(kind, a.size, is_moved(first_frame), b.size);
  check_size(file, element, result.size);
  result.solid = combine(name, placed(*a.solid, first_frame), placed(*b.solid, second_frame));
  return result;
}

/// Makes a union of many solids from two unions of half of them each.
Solid union_of_all(const std::string& name, const std::vector<Solid>& nodes, std::size_t first,
                   std::size_t count) {
  if (count == 1) return nodes[first];
  const std::size_t half = count / 2;
  return make_union(name, union_of_all(name, nodes, first, half),
                    union_of_all(name, nodes, first + half, count - half));
}

NamedSolid read_multi_union(FileContext& file, const XmlElement& element, const std::string& name) {
  std::vector<Solid> nodes;
  NamedSolid result;
  result.size.parts = 0;
  for (const XmlElement& node : element.children()) {
    if (node.tag != "multiUnionNode") fail(node, "unknown element here; use multiUnionNode");
    file.charge(node);
    const NamedSolid* solid = nullptr;
    Frame frame;
    for (const XmlElement& child : node.children()) {
      if (child.tag == "solid") {
        solid = &find_solid(file, child);
      } else if (!read_frame(file, child, "", frame)) {
        fail(child, "unknown element in a multiUnionNode; remove it");
      }
    }
    if (solid == nullptr) fail(node, "it has no <solid>; name one");
    nodes.push_back(placed(*solid->solid, frame));
    result.size.depth = std::max(result.size.depth, solid->size.depth);
    result.size.parts += solid->size.parts;
    result.size.links = std::max(result.size.links, solid->size.links);
  }
  if (nodes.empty()) fail(element, "it has no <multiUnionNode>; add some");
  return united(file, element, name, nodes, result.size);
}

NamedSolid read_scaled(FileContext& file, const XmlElement& element, const std::string& name) {
  const NamedSolid* solid = nullptr;
  Vector scale{1, 1, 1};
  for (const XmlElement& child : element.children()) {
    if (child.tag == "solidref") {
      solid = &find_solid(file, child);
    } else if (child.tag == "scale") {
      scale = file.vector(child, Dimension::other, 1);
    } else if (child.tag == "scaleref") {
      scale = file.look_up(file.scales, child, "scale", file.reference(child));
    } else {
      fail(child, "unknown element in a scaledSolid; use solidref, scale or scaleref");
    }
  }
  if (solid == nullptr) fail(element, "it has no <solidref>; name a solid");
  NamedSolid result;
  result.size.depth = solid->size.depth + 1;
  result.size.links = solid->size.links + 1;
  result.size.parts = solid->size.parts;
  check_size(file, element, result.size);
  result.solid = make_scaled(name, *solid->solid, scale[0], scale[1], scale[2]);
  return result;
}

/// The solid scaled by (sx, sy, sz), turned and moved, all given as attributes.
NamedSolid read_reflected(FileContext& file, const XmlElement& element, const std::string& name) {
  const NamedSolid& solid = find_solid(file, element, "solid");
  const double length = file.unit(element, "lunit", Dimension::length);
  const double angle = file.unit(element, "aunit", Dimension::angle);
  Frame frame;
  double scale[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const char axis = "xyz"[i];
    frame.position[i] = file.length(element, std::string("d") + axis, length, 0);
    frame.rotation[i] = file.number(element, std::string("r") + axis, 0) * angle;
    scale[i] = file.number(element, std::string("s") + axis, 1);
  }
  NamedSolid result;
  result.size.depth = solid.size.depth + 2;
  result.size.links = solid.size.links + 1;
  result.size.parts = solid.size.parts;
  check_size(file, element, result.size);
  result.solid = placed(make_scaled(name, *solid.solid, scale[0], scale[1], scale[2]), frame);
  return result;
}

template <Combine combine, Boolean kind>
NamedSolid read_with(FileContext& file, const XmlElement& element, const std::string& name) {
  return read_boolean(file, element, name, combine, kind);
}

constexpr SolidKindReader readers[] = {
    {"subtraction", read_with<make_subtraction, Boolean::cut>},
    {"union", read_with<make_union, Boolean::join>},
    {"intersection", read_with<make_intersection, Boolean::meet>},
    {"multiUnion", read_multi_union},
    {"scaledSolid", read_scaled},
    {"reflectedSolid", read_reflected},
};

}  // namespace

NamedSolid united(FileContext& file, const XmlElement& element, const std::string& name,
                  const std::vector<Solid>& solids, BooleanSize size) {
  for (std::size_t n = 1; n < solids.size(); n *= 2) ++size.depth;
  check_size(file, element, size);
  NamedSolid result;
  result.size = size;
  result.solid = union_of_all(name, solids, 0, solids.size());
  result.solid->name = name;
  return result;
}

std::span<const SolidKindReader> boolean_readers() { return readers; }

}  // namespace navjit::gdml
