#include "geometry/gdml/write/solids.hpp"

#include <cmath>

#include "geometry/gdml/write/frames.hpp"
#include "geometry/solids/make.hpp"

namespace navjit::gdml {
namespace {

bool is_identity(const Transformation& t) { return t == Transformation{}; }

/// The frame `b` as it is seen from the frame `a`.
Transformation relative(const Transformation& a, const Transformation& b) {
  const Vec3 t = to_local(a, Vec3{b.translation[0], b.translation[1], b.translation[2]});
  double rotation[9];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      rotation[3 * i + j] = b.rotation[3 * i] * a.rotation[3 * j] +
                            b.rotation[3 * i + 1] * a.rotation[3 * j + 1] +
                            b.rotation[3 * i + 2] * a.rotation[3 * j + 2];
    }
  }
  return make_transformation({t.x, t.y, t.z}, rotation);
}

/// Writes a boolean without the frame of its first operand, and returns that frame. If the order of
/// the operands does not matter, one without a frame comes first.
template <class Shape>
Transformation write_boolean(SolidWriter& out, const char* tag, const std::string& name,
                             const Shape& s, bool ordered) {
  WrittenSolid a = out.add_operand(s.a.solid, name + "_a");
  WrittenSolid b = out.add_operand(s.b.solid, name + "_b");
  if (!ordered && !is_identity(a.frame) && is_identity(b.frame)) std::swap(a, b);
  const Transformation second = is_identity(a.frame) ? b.frame : relative(a.frame, b.frame);
  out.write(tag, name, "",
            "<first" + attribute("ref", a.name) + "/><second" + attribute("ref", b.name) + "/>" +
                operand_text(name, second));
  return a.frame;
}

}  // namespace

WrittenSolid SolidWriter::add_operand(const kernels::AnySolid<double>& solid,
                                      const std::string& name) {
  if (solid.kind == SolidKind::placed) {
    const auto& placed = *static_cast<const kernels::AnyPlaced<double>*>(solid.shape);
    WrittenSolid inner = add_operand(placed.solid, name);
    const Transformation frame = make_transformation(placed.translation, placed.rotation);
    inner.frame = is_identity(inner.frame) ? frame : compose(frame, inner.frame);
    if (mirrors(inner.frame)) {
      // GDML mirrors no operands: the solid itself is mirrored.
      const std::string own = names_.own(name + "_mirrored");
      write("scaledSolid", own, "",
            "<solidref" + attribute("ref", inner.name) + "/><scale" +
                attributes({{"x", 1}, {"y", 1}, {"z", -1}}) + "/>");
      inner = {own, without_mirror(inner.frame)};
    }
    return inner;
  }
  const auto found = written_.find({solid.shape, solid.kind});
  if (found != written_.end()) return found->second;
  WrittenSolid made{names_.own(name)};
  kernels::visit(solid, [&](const auto& shape) {
    using Shape = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Shape, kernels::QuadricSolid<double>>) {
      write_quadric(*this, made.name, solid.kind, shape);
    } else if constexpr (std::is_same_v<Shape, kernels::TwistedTrap<double>>) {
      write_twisted(*this, made.name, solid.kind, shape);
    } else if constexpr (std::is_same_v<Shape, kernels::AnyUnion<double>>) {
      made.frame = write_boolean(*this, "union", made.name, shape, false);
    } else if constexpr (std::is_same_v<Shape, kernels::AnyIntersection<double>>) {
      made.frame = write_boolean(*this, "intersection", made.name, shape, false);
    } else if constexpr (std::is_same_v<Shape, kernels::AnySubtraction<double>>) {
      made.frame = write_boolean(*this, "subtraction", made.name, shape, true);
    } else if constexpr (!std::is_same_v<Shape, kernels::AnyPlaced<double>>) {
      write_shape(*this, made.name, shape);
    }
  });
  written_.emplace(std::pair{solid.shape, solid.kind}, made);
  return made;
}

std::string SolidWriter::add(const kernels::AnySolid<double>& solid, const std::string& name) {
  const auto known = placed_.find({solid.shape, solid.kind});
  if (known != placed_.end()) return known->second;
  const WrittenSolid made = add_operand(solid, name);
  std::string own = made.name;
  if (!is_identity(made.frame)) {
    own = names_.own(name + "_placed");
    write("multiUnion", own, "",
          "<multiUnionNode" + attribute("name", own + "_node") + "><solid" +
              attribute("ref", made.name) + "/>" + operand_text(own, made.frame) +
              "</multiUnionNode>");
  }
  placed_.emplace(std::pair{solid.shape, solid.kind}, own);
  return own;
}

void SolidWriter::write(std::string_view tag, const std::string& name, const std::string& given,
                        const std::string& inner) {
  solids_ += "    <" + std::string(tag) + attribute("name", name) + given;
  solids_ += inner.empty() ? "/>\n" : '>' + inner + "</" + std::string(tag) + ">\n";
}

std::string SolidWriter::define(const std::string& name, const Vec3& p) {
  std::string own = positions_.own(name);
  definitions_ += "    <position" + attribute("name", own) +
                  attributes({{"x", p.x}, {"y", p.y}, {"z", p.z}}) + attribute("unit", "mm") +
                  "/>\n";
  return own;
}

std::string wedge_text(const kernels::Wedge<double>& w) {
  const double start = w.kind == 0 ? 0 : std::atan2(w.start_y, w.start_x);
  return attributes({{"startphi", start}, {"deltaphi", navjit::detail::angle_of(w)}}) + in_rad();
}

void write_shape(SolidWriter&, const std::string& name, const kernels::ForeignShape&) {
  throw GeometryError("solid '" + name +
                      "' is a foreign one, which GDML has no words for: leave its volume out");
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::AnyScaled<double>& s) {
  const std::string inner = out.add(s.solid, name + "_unscaled");
  out.write(
      "scaledSolid", name, "",
      "<solidref" + attribute("ref", inner) + "/><scale" +
          attributes({{"x", 1 / s.inverse_x}, {"y", 1 / s.inverse_y}, {"z", 1 / s.inverse_z}}) +
          "/>");
}

}  // namespace navjit::gdml
