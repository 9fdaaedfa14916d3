// TGeoCompositeShape: a boolean of two shapes, each of which has a matrix.
#include <algorithm>

#include "geometry/root/composites.hpp"

namespace navjit::root {
namespace {

bool is_identity(const Transformation& t) {
  return !t.rotated && std::ranges::all_of(t.translation, [](double x) { return x == 0; });
}

}  // namespace

Transformation transformation_at(Reading& reading, Reference matrix) {
  return transformation_of(read_frame(reading, matrix));
}

Operand operand(const MadeSolid& made, const Transformation& at) {
  if (is_identity(at)) return {made.solid, made.size};
  SolidFrame frame;
  std::ranges::copy(at.translation, frame.translation);
  std::ranges::copy(at.rotation, frame.rotation);
  return {make_placed(made.solid.name, made.solid, frame), made.size, true};
}

Composite parts_of(Reading& reading, const Object& composite) {
  const Reference node_reference = composite.reference("fNode");
  if (node_reference == 0) composite.fail("it has no operation");
  const Object& node = reading.objects.at(node_reference);
  Composite parts{.left = node.reference("fLeft"),
                  .right = node.reference("fRight"),
                  .left_matrix = node.reference("fLeftMat"),
                  .right_matrix = node.reference("fRightMat")};
  if (parts.left == 0 || parts.right == 0) composite.fail("it lacks an operand");
  if (node.is("TGeoUnion")) {
    parts.operation = Boolean::join;
  } else if (node.is("TGeoSubtraction")) {
    parts.operation = Boolean::cut;
  } else if (node.is("TGeoIntersection")) {
    parts.operation = Boolean::meet;
  } else {
    composite.fail("unsupported operation " + node.type +
                   "; union, subtraction and intersection are read");
  }
  return parts;
}

void check_size(Reading& reading, const Object& shape, const BooleanSize& size) {
  const RootLimits& limits = reading.limits;
  const std::string problem =
      excess(size,
             {limits.max_solid_depth, limits.max_solid_chain, limits.max_solid_parts, "RootLimits",
              "join its operands in pairs"},
             reading.boolean_parts);
  if (!problem.empty()) shape.fail(problem);
}

MadeSolid combine(Reading& reading, const Object& composite, Boolean operation, const Operand& a,
                  const Operand& b) {
  const BooleanSize size = size_of(operation, a.size, a.moved, b.size);
  check_size(reading, composite, size);
  switch (operation) {
    case Boolean::join:
      return {make_union(composite.name, a.solid, b.solid), size};
    case Boolean::cut:
      return {make_subtraction(composite.name, a.solid, b.solid), size};
    case Boolean::meet:
      break;
  }
  return {make_intersection(composite.name, a.solid, b.solid), size};
}

MadeSolid read_boolean(Reading& reading, const Object& composite, std::size_t depth) {
  const Composite parts = parts_of(reading, composite);
  const Transformation left = transformation_at(reading, parts.left_matrix);
  const Transformation right = transformation_at(reading, parts.right_matrix);
  const auto solid_of = [&](Reference shape, const Transformation& at) {
    return operand(read_solid(reading, shape, depth + 1), at);
  };
  const auto within = [&](Reference shape, const Transformation& at, const Operand& other) {
    return read_within(reading, shape, at, other.solid.extent, depth + 1);
  };
  if (is_endless(reading, parts.left, depth + 1)) {
    const Operand b = solid_of(parts.right, right);
    return combine(reading, composite, parts.operation, within(parts.left, left, b), b);
  }
  const Operand a = solid_of(parts.left, left);
  return combine(reading, composite, parts.operation, a,
                 is_endless(reading, parts.right, depth + 1) ? within(parts.right, right, a)
                                                             : solid_of(parts.right, right));
}

}  // namespace navjit::root
