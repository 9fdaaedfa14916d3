// What the readers of shapes that are made of other shapes share.
#pragma once

#include "geometry/root/reading.hpp"

namespace navjit::root {

/// An operand of a boolean, and where it is placed in that.
struct Operand {
  Solid solid;
  BooleanSize size{};
  bool moved = false;
};

/// The parts of a TGeoCompositeShape.
struct Composite {
  Boolean operation = Boolean::join;
  Reference left = 0, right = 0, left_matrix = 0, right_matrix = 0;
};
Composite parts_of(Reading& reading, const Object& composite);

/// The transformation of a TGeoMatrix; the identity where there is none.
Transformation transformation_at(Reading& reading, Reference matrix);
/// `at` says where the solid is in the boolean.
Operand operand(const MadeSolid& made, const Transformation& at);
/// Makes the boolean, if it is not too large.
MadeSolid combine(Reading& reading, const Object& composite, Boolean operation, const Operand& a,
                  const Operand& b);
/// Fails if a shape that is made of others is too large.
void check_size(Reading& reading, const Object& shape, const BooleanSize& size);
/// Fails if shapes are nested without an end, or too deeply.
void check_nesting(Reading& reading, const Object& shape, std::size_t depth);

/// Reads a TGeoCompositeShape that is finite.
MadeSolid read_boolean(Reading& reading, const Object& composite, std::size_t depth);

/// Whether a shape is infinite: a TGeoHalfSpace, or a boolean that leaves an infinite part of one.
bool is_endless(Reading& reading, Reference shape, std::size_t depth);
/// A solid that is the same as a shape within a region, where the shape may be infinite; elsewhere
/// it may differ. `at` says where the shape is in the frame of the region.
Operand read_within(Reading& reading, Reference shape, const Transformation& at,
                    const Extent& region, std::size_t depth);

}  // namespace navjit::root
