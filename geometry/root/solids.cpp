// Reads ROOT's shapes, also those that are made of others.
#include <algorithm>

#include "geometry/root/composites.hpp"

namespace navjit::root {
namespace {

MadeSolid read_scaled(Reading& reading, const Object& shape, std::size_t depth) {
  const Object& scale = reading.objects.at(shape.reference("fScale"));
  const std::span<const double> factors = scale.numbers("fScale", 3);
  const MadeSolid& inner = read_solid(reading, shape.reference("fShape"), depth + 1);
  const BooleanSize size{
      .depth = inner.size.depth + 1, .parts = inner.size.parts, .links = inner.size.links + 1};
  check_size(reading, shape, size);
  return {make_scaled(shape.name, inner.solid, factors[0], factors[1], factors[2]), size};
}

MadeSolid make(Reading& reading, Reference reference, std::size_t depth) {
  const Object& shape = reading.objects.at(reference);
  check_nesting(reading, shape, depth);
  if (is_endless(reading, reference, depth)) {
    shape.fail(
        "half of space has no end, nor has this; intersect it with a solid, or subtract it from "
        "one");
  }
  try {
    if (shape.is("TGeoCompositeShape")) return read_boolean(reading, shape, depth);
    if (shape.is("TGeoXtru")) return read_extruded(reading, shape);
    if (shape.is("TGeoTessellated")) return {read_tessellated(reading, shape)};
    if (shape.is("TGeoScaledShape")) return read_scaled(reading, shape, depth);
    return {read_primitive(shape)};
  } catch (const GeometryError& e) {
    shape.fail(e.what());
  }
}

}  // namespace

void check_nesting(Reading& reading, const Object& shape, std::size_t depth) {
  // This counts what is read by recursion; the solid that is made may have fewer levels.
  const std::size_t most = std::max(reading.limits.max_solid_depth, reading.limits.max_solid_chain);
  if (depth > most) {
    shape.fail("more than " + std::to_string(most) +
               " shapes are within one another; raise RootLimits::max_solid_chain if this is "
               "meant");
  }
}

const MadeSolid& read_solid(Reading& reading, Reference reference, std::size_t depth) {
  const auto known = reading.solids.find(reference);
  if (known != reading.solids.end()) return known->second;
  MadeSolid made = make(reading, reference, depth);
  return reading.solids.insert_or_assign(reference, std::move(made)).first->second;
}

}  // namespace navjit::root
