// <solids>: how GDML writes each kind of solid, found again from the numbers of its kernel.
#pragma once

#include <map>
#include <string>

#include "geometry/gdml/write/xml_text.hpp"
#include "geometry/model/transformation.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit::gdml {

/// A solid that was written, and the frame that it has to be placed in: GDML places the second
/// operands of booleans and no others. (Geant4 reads a frame of the first, but VecGeom does not.)
struct WrittenSolid {
  std::string name;
  Transformation frame{};
};

/// Collects solids; each comes after those that it is made of.
class SolidWriter {
 public:
  /// The name by which to refer to the solid; writes the solid unless it was written before. Throws
  /// GeometryError if it cannot be expressed in GDML.
  std::string add(const Solid& solid) { return add(solid.any(), solid.name); }
  std::string add(const kernels::AnySolid<double>& solid, const std::string& name);
  /// Writes an operand, without the frame that it is placed in.
  WrittenSolid add_operand(const kernels::AnySolid<double>& solid, const std::string& name);
  /// A name for a part of a solid that is written as several solids.
  std::string own_name(const std::string& name) { return names_.own(name); }
  /// Writes a solid: <tag name='...' ...>inner</tag>.
  void write(std::string_view tag, const std::string& name, const std::string& attributes,
             const std::string& inner = "");
  /// Writes a position in <define>; returns the name by which to refer to it.
  std::string define(const std::string& name, const Vec3& position);

  const std::string& definitions() const { return definitions_; }  ///< the text of <define>
  const std::string& solids() const { return solids_; }            ///< the text of <solids>

 private:
  std::map<std::pair<const void*, SolidKind>, WrittenSolid> written_;
  std::map<std::pair<const void*, SolidKind>, std::string> placed_;
  NameBook names_, positions_;
  std::string definitions_, solids_;
};

// One function for each shape; `name` is the solid's own.
void write_shape(SolidWriter& out, const std::string& name, const kernels::Box<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Trd<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Trap<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Arb8<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Hull<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Facets<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Prism<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Tube<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::CutTube<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Cone<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Orb<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Sphere<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Torus<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Polycone<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::Polyhedra<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::TwistedTube<double>& s);
void write_shape(SolidWriter& out, const std::string& name, const kernels::AnyScaled<double>& s);
[[noreturn]] void write_shape(SolidWriter& out, const std::string& name,
                              const kernels::ForeignShape& s);
/// For shapes of several kinds.
void write_quadric(SolidWriter& out, const std::string& name, SolidKind kind,
                   const kernels::QuadricSolid<double>& s);
void write_twisted(SolidWriter& out, const std::string& name, SolidKind kind,
                   const kernels::TwistedTrap<double>& s);

/// The angles of a wedge as GDML writes them, with their unit.
std::string wedge_text(const kernels::Wedge<double>& wedge);
inline std::string in_mm() { return attribute("lunit", "mm"); }
inline std::string in_rad() { return attribute("aunit", "rad"); }

}  // namespace navjit::gdml
