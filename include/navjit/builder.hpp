// Makes a detector in code.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/detector.hpp"

namespace NAVJIT_API navjit {

/// Collects materials, volumes and placements; build() gives the detector. What is added is checked
/// at once, and if an exception is thrown the builder stays as it was. Nothing can be navigated
/// before build(), so that no detector is half finished. For one thread at a time. Lengths are mm,
/// angles rad.
///
///   DetectorBuilder builder;
///   const auto pb = builder.element({.name = "Pb", .z = 82, .a = 207.2});
///   const auto lead = builder.material({.name = "Lead", .density = 11.35, .elements = {{pb, 1}}});
///   const auto hall = builder.volume("hall", make_box("hall", 500, 500, 500), air);
///   const auto brick = builder.volume("brick", make_box("brick", 50, 50, 50), lead);
///   builder.place(brick, hall, placed_at({0, 0, 100}));
///   Runtime runtime{builder.build(hall)};
class DetectorBuilder {
 public:
  /// The numbers of what was added, for later calls of the same builder.
  using IsotopeId = std::uint32_t;
  using ElementId = std::uint32_t;
  using MaterialId = std::uint32_t;

  /// Starts empty.
  DetectorBuilder();
  /// Starts from a detector, which stays as it is: for example, to add user data to what was read
  /// from a file. Volumes and materials keep their numbers.
  explicit DetectorBuilder(const Detector& detector);
  DetectorBuilder(const DetectorBuilder&) = delete;
  DetectorBuilder& operator=(const DetectorBuilder&) = delete;
  ~DetectorBuilder();

  /// Adds an isotope, for elements. Throws GeometryError if a number is negative or not finite.
  IsotopeId isotope(Isotope isotope);
  /// Adds an element, for materials. Its molar mass has to be given even if its isotopes are.
  /// Throws GeometryError if a number is negative or not finite, or if there is no such isotope.
  ElementId element(Element element);
  /// Adds a material. Its fractions are scaled to add up to one; a radiation length that is not
  /// given is computed from the elements. Throws GeometryError if a number is negative or not
  /// finite, if there is no such element, or if no element has a fraction.
  MaterialId material(Material material);
  /// Adds a logical volume. Throws GeometryError if there is no such material, or if the solid was
  /// not made by make_box or another maker of solids.
  VolumeId volume(std::string name, Solid solid, MaterialId material);
  /// Places a volume in a mother, after the mother's other daughters: on a face that daughters
  /// share, the first of them counts. Returns the number of the placement in the mother; without a
  /// name it gets the volume's name with that number. Throws GeometryError if there is no such
  /// volume, if the transformation is not orthonormal, or if the volume would contain itself.
  std::uint32_t place(VolumeId volume, VolumeId mother, const Transformation& where = {},
                      int copy_number = 0, std::string name = {});

  /// Sets the simulation's own number for a volume, or for a placement (by its number in the
  /// mother): an index, or a pointer cast to it. Throws GeometryError if there is no such thing.
  void set_user_data(VolumeId volume, std::uint64_t data);
  void set_user_data(VolumeId mother, std::uint32_t daughter, std::uint64_t data);
  /// Adds a tag to a volume or to a placement. Throws as set_user_data() does.
  void add_auxiliary(VolumeId volume, Auxiliary auxiliary);
  void add_auxiliary(VolumeId mother, std::uint32_t daughter, Auxiliary auxiliary);

  /// The detector in which `world` holds everything; volumes that are not in it are kept, but not
  /// navigated. The builder may be used further; detectors that it built do not change. Throws
  /// GeometryError if there is no such volume, or if the tree is deeper than 64 levels or has more
  /// than 2^62 touchables. Overlaps are not looked for: `navjit check` does that for files.
  Detector build(VolumeId world) const;

 private:
  std::unique_ptr<World> world_;
};

}  // namespace navjit
