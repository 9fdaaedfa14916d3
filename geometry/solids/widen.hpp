// The same solid with another type of number, for references in higher precision. The numbers are
// not changed: the shape in double is the definition.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/solids/fields.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit {

/// Owns a copy of a solid, with everything that it is made of, in numbers of type Real.
template <class Real>
class WideSolid {
 public:
  /// Throws GeometryError if the solid contains a foreign solid.
  explicit WideSolid(const Solid& solid) : name_(solid.name), root_(wide(solid.any())) {}

  /// Valid as long as this object or a copy of it lives.
  kernels::AnySolid<Real> any() const { return root_; }

 private:
  kernels::AnySolid<Real> wide(const kernels::AnySolid<double>& s) {
    const void* shape = kernels::visit(s, [this](const auto& from) -> const void* {
      auto to = this->wide(from);
      return this->keep(std::make_shared<decltype(to)>(to));
    });
    return {s.kind, shape};
  }
  template <class Shape>
  const Shape* keep(std::shared_ptr<Shape> shape) {
    const Shape* kept = shape.get();
    kept_.push_back(std::move(shape));
    return kept;
  }
  template <class Element>
  auto wide_array(const Element* from, int count) {
    using WideElement = decltype(wide(*from));
    auto to = std::make_shared<std::vector<WideElement>>();
    for (int i = 0; i < count; ++i) to->push_back(wide(from[i]));
    return keep(std::move(to))->data();
  }

  static Real wide(double x) { return static_cast<Real>(x); }
  static int wide(int n) { return n; }
  static kernels::Facet wide(const kernels::Facet& s) { return s; }
  /// These are read in double precision only.
  static kernels::FacetGroup<Real> wide(const kernels::FacetGroup<double>&) { return {}; }
  static kernels::FacetLeaf<Real> wide(const kernels::FacetLeaf<double>&) { return {}; }

  /// Converts field by field.
  template <template <class> class Shape>
  Shape<Real> wide(const Shape<double>& from) {
    Shape<Real> to{};
    const auto wide_fields = kernels::fields_of(to);
    const auto fields = kernels::fields_of(from);
    kernels::for_each_field<Shape<double>>([&](auto at) {
      const auto& field = std::get<at>(fields);
      if constexpr (std::is_pointer_v<std::decay_t<decltype(field)>>) {
        std::get<at>(wide_fields) = this->wide_array(field, std::get<at + 1>(fields));
      } else {
        std::get<at>(wide_fields) = this->wide(field);
      }
    });
    return to;
  }

  kernels::ForeignShape wide(const kernels::ForeignShape&) const {
    throw GeometryError("solid '" + name_ +
                        "': a foreign solid answers in double precision alone, and has no wider "
                        "form to judge it by");
  }
  kernels::AnyScaled<Real> wide(const kernels::AnyScaled<double>& s) {
    return {wide(s.solid), wide(s.inverse_x), wide(s.inverse_y), wide(s.inverse_z), wide(s.most)};
  }
  kernels::AnyPlaced<Real> wide(const kernels::AnyPlaced<double>& s) {
    kernels::AnyPlaced<Real> to{wide(s.solid), s.rotated, {}, {}};
    std::copy_n(s.translation, 3, to.translation);
    std::copy_n(s.rotation, 9, to.rotation);
    return to;
  }
  // The reference looks at every operand.
  kernels::AnyOperand<Real> wide(const kernels::AnyOperand<double>& s) {
    return {wide(s.solid), 0, {}, {}};
  }
  kernels::AnyUnion<Real> wide(const kernels::AnyUnion<double>& s) {
    return {wide(s.a), wide(s.b)};
  }
  kernels::AnyIntersection<Real> wide(const kernels::AnyIntersection<double>& s) {
    return {wide(s.a), wide(s.b)};
  }
  kernels::AnySubtraction<Real> wide(const kernels::AnySubtraction<double>& s) {
    return {wide(s.a), wide(s.b)};
  }

  std::string name_;
  std::vector<std::shared_ptr<const void>> kept_;
  kernels::AnySolid<Real> root_;
};

/// The solid in numbers of type Real, which holds every double exactly.
template <class Real>
WideSolid<Real> widen(const Solid& solid) {
  return WideSolid<Real>(solid);
}

}  // namespace navjit
