// Between the readers of shapes that are made of others.
#pragma once

#include "geometry/root/reading.hpp"

namespace navjit::root {

/// An operand of a boolean, where it is in it.
struct Operand {
  Solid solid;
  BooleanSize size{};
  bool moved = false;
};

/// What a TGeoCompositeShape consists of.
struct Composite {
  Boolean operation = Boolean::join;
  Reference left = 0, right = 0, left_matrix = 0, right_matrix = 0;
};
Composite parts_of(Reading& reading, const Object& composite);

/// Of a TGeoMatrix; the identity where there is none.
Transformation transformation_at(Reading& reading, Reference matrix);
/// `at`: where the solid is in the boolean.
Operand operand(const MadeSolid& made, const Transformation& at);
/// The boolean, if it is not too large.
MadeSolid combine(Reading& reading, const Object& composite, Boolean operation, const Operand& a,
                  const Operand& b);
/// Fails where a shape that is made of others is too large.
void check_size(Reading& reading, const Object& shape, const BooleanSize& size);
/// Fails where shapes are within one another without an end, or nearly.
void check_nesting(Reading& reading, const Object& shape, std::size_t depth);

/// A TGeoCompositeShape that has an end.
MadeSolid read_boolean(Reading& reading, const Object& composite, std::size_t depth);

/// Whether a shape reaches as far as one likes: a TGeoHalfSpace, and what booleans leave of one.
bool is_endless(Reading& reading, Reference shape, std::size_t depth);
/// A solid that is the same as a shape within a region, where the shape may have no end. What it is
/// elsewhere does not matter. `at`: where the shape is in the frame that the region is in.
Operand read_within(Reading& reading, Reference shape, const Transformation& at,
                    const Extent& region, std::size_t depth);

}  // namespace navjit::root
