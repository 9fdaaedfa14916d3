// A detector, and what can be asked of it without a point.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/material.hpp"
#include "navjit/state.hpp"
#include "navjit/transformation.hpp"
#include "navjit/volume.hpp"

namespace NAVJIT_API navjit {

struct World;  ///< the library's own representation of a detector

/// One placement on the way down the tree, by name: for touchables of other engines.
struct NamedPlacement {
  std::string name;
  int copy_number = 0;
};

/// A handle to an immutable detector: volumes, materials, and the tree of touchables. Copies share
/// the detector. Made by read_gdml or by a DetectorBuilder. All functions may be called by any
/// number of threads. Those that take a State throw UsageError if it is outside the world, or is
/// recognised as one of another detector; those that take a number throw UsageError if there is no
/// such volume, material, element or isotope.
class Detector {
 public:
  /// For the library's own parts, which fill in a World. Throws GeometryError if there is none, or
  /// if it is not finished.
  Detector(World world);
  Detector(std::shared_ptr<const World> world);
  const std::shared_ptr<const World>& model() const { return world_; }

  /// How many logical volumes there are; their numbers are below that.
  std::size_t volumes() const;
  /// The logical volume that holds all others.
  VolumeId world_volume() const;
  const LogicalVolume& volume(VolumeId volume) const;
  const LogicalVolume& volume(const State& state) const { return volume(checked(state).volume()); }
  /// The first volume in file order that has the name; nothing if there is none.
  std::optional<VolumeId> find_volume(std::string_view name) const;

  /// How many materials there are, and one of them by its number. Throws UsageError if there is no
  /// such material.
  std::size_t materials() const;
  const Material& material(std::uint32_t material) const;
  /// For a volume made in code without a material: one without a name and of density 0.
  const Material& material(const LogicalVolume& volume) const;
  const Material& material(const State& state) const { return material(volume(state)); }

  /// The elements of materials (Material::elements) and isotopes of elements (Element::isotopes).
  std::size_t elements() const;
  const Element& element(std::uint32_t element) const;
  std::size_t isotopes() const;
  const Isotope& isotope(std::uint32_t isotope) const;

  /// Tags of the whole detector: GDML's `<userinfo>`. Null if there are none.
  const Auxiliaries& auxiliaries() const;

  /// Points nearer to a face than this count as on it, mm (docs/tolerance.md).
  double tolerance() const;
  /// The levels of the tree: 1 for a lone world volume.
  int levels() const;
  TouchableId touchables() const;

  // Where a state is in the tree. Time grows with its depth, and with the logarithm of the number
  // of daughters.

  /// How deep the touchable is in the tree: 0 for the world volume.
  int depth(const State& state) const;
  /// The state of its mother; outside the world for the world volume.
  State mother(const State& state) const;
  /// The touchable around it at a depth from 0 to depth(state); UsageError for other depths.
  State ancestor(const State& state, int depth) const;
  /// How it is placed in its mother; null for the world volume.
  const Placement* placement(const State& state) const;
  /// The copy number of its placement; 0 for the world volume.
  int copy_number(const State& state) const;
  /// From the world's frame into the touchable's: the same bits that navigation uses.
  Transformation frame(const State& state) const;
  /// "world/mother/daughter": the world volume's name, then placement names down to it.
  std::string path_of(const State& state) const;

  /// Numbers of daughters (LogicalVolume::daughters) from the world volume down; empty for the
  /// world volume itself.
  std::vector<std::uint32_t> path(const State& state) const;
  /// The inverse of path(). Throws UsageError if there is no such daughter.
  State state_at(std::span<const std::uint32_t> path) const;
  /// The same by names and copy numbers of placements: the first in file order that has both.
  /// Throws UsageError, which names the placement, where no daughter has both.
  State state_at(std::span<const NamedPlacement> path) const;

 private:
  const State& checked(const State& state) const;

  std::shared_ptr<const World> world_;
};

}  // namespace navjit
