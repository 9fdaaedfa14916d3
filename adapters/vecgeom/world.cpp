#include "adapters/vecgeom/world.hpp"

#include <VecGeom/volumes/LogicalVolume.h>

#include <bit>
#include <string>
#include <unordered_set>
#include <utility>

#include "adapters/vecgeom/shapes.hpp"
#include "adapters/vecgeom/transformations.hpp"

namespace navjit::vecgeom {
namespace {

using ::vecgeom::LogicalVolume;
using ::vecgeom::VPlacedVolume;

/// The placed volumes on the way from a volume to a daughter: assemblies, then the daughter.
using Way = std::vector<Paths::Index>;

class Conversion {
 public:
  Conversion(double mm, const MaterialOf& material) : mm_(mm), material_(material) {}

  ConvertedWorld convert(const VPlacedVolume& world) {
    if (world.IsAssembly())
      throw GeometryError("VecGeom: the world '" + world.GetLabel() + "' is an assembly");
    const std::optional<VolumeId> added = add(*world.GetLogicalVolume());
    if (!added) throw GeometryError("VecGeom: the world '" + world.GetLabel() + "' holds no point");
    const VolumeId top = *added;
    const Detector detector = builder_.build(top);
    Paths paths;
    paths.world = NavigationState::ToIndex(&world);
    number(paths, world, 0, top);
    for (const auto& [volume, id] : volumes_) number_daughters(paths, detector, *volume, 1);
    for (const auto& [volume, touchables] : assemblies_)
      number_daughters(paths, detector, *volume, 0);
    paths.assemblies = !assemblies_.empty();
    for (VolumeId v = 0; v < ways_.size(); ++v) {
      paths.touchables.push_back(detector.volume(v).touchables);
      paths.first.push_back(static_cast<std::uint32_t>(paths.placed.size()));
      for (const Way& way : ways_[v]) {
        paths.placed.push_back(static_cast<std::uint32_t>(paths.indices.size()));
        paths.indices.insert(paths.indices.end(), way.begin(), way.end());
      }
    }
    paths.placed.push_back(static_cast<std::uint32_t>(paths.indices.size()));
    std::vector<std::string> empty;
    for (const LogicalVolume* volume : empty_) empty.push_back(volume->GetLabel());
    return {detector, std::move(paths), std::move(volumes_), std::move(empty)};
  }

 private:
  /// Adds a volume; nothing if it holds no point.
  std::optional<VolumeId> add(const LogicalVolume& volume) {
    if (const auto found = volumes_.find(&volume); found != volumes_.end()) return found->second;
    if (empty_.contains(&volume)) return std::nullopt;
    const std::string& name = volume.GetLabel();
    VolumeId id;
    try {
      const std::optional<Solid> solid = solid_of(*volume.GetUnplacedVolume(), name, mm_);
      if (!solid) {
        empty_.insert(&volume);
        return std::nullopt;
      }
      id = builder_.volume(name, *solid, material_of(volume));
    } catch (const GeometryError& error) {
      throw GeometryError("VecGeom's volume '" + name + "': " + error.what());
    }
    builder_.set_user_data(id, std::bit_cast<std::uintptr_t>(&volume));
    volumes_.emplace(&volume, id);
    ways_.resize(id + 1);
    place_daughters(volume, volume, id, {}, {});
    return id;
  }

  /// Places the daughters of `of`, which is the volume `in` or an assembly within it, in `in`.
  void place_daughters(const LogicalVolume& of, const LogicalVolume& in, VolumeId id,
                       const Transformation& outer, const Way& above) {
    for (const VPlacedVolume* placed : of.GetDaughters()) {
      try {
        const Transformation inner = transformation_of(*placed->GetTransformation(), mm_);
        const Transformation where = above.empty() ? inner : compose(outer, inner);
        Way way = above;
        way.push_back(NavigationState::ToIndex(placed));
        if (placed->IsAssembly()) {
          place_daughters(*placed->GetLogicalVolume(), in, id, where, way);
          assemblies_.try_emplace(placed->GetLogicalVolume());
          continue;
        }
        const std::optional<VolumeId> daughter = add(*placed->GetLogicalVolume());
        if (!daughter) continue;  // it is never entered
        const std::uint32_t at =
            builder_.place(*daughter, id, where, placed->GetCopyNo(), placed->GetLabel());
        builder_.set_user_data(id, at, std::bit_cast<std::uintptr_t>(placed));
        ways_[id].push_back(std::move(way));
      } catch (const GeometryError& error) {
        const std::string text = error.what();
        if (text.starts_with("VecGeom")) throw;
        throw GeometryError("VecGeom's placement '" + placed->GetLabel() + "' in volume '" +
                            in.GetLabel() + "': " + text);
      }
    }
  }

  DetectorBuilder::MaterialId material_of(const LogicalVolume& volume) {
    if (material_) return material_(builder_, volume);
    if (!placeholder_) placeholder_ = builder_.material({});
    return *placeholder_;
  }

  /// The number of touchables that a placed volume adds to what it is placed in.
  TouchableId touchables(const Detector& detector, const VPlacedVolume& placed) {
    const LogicalVolume* volume = placed.GetLogicalVolume();
    if (empty_.contains(volume)) return 0;
    if (!placed.IsAssembly()) return detector.volume(volumes_.at(volume)).touchables;
    std::optional<TouchableId>& known = assemblies_.at(volume);
    if (known) return *known;
    TouchableId sum = 0;
    for (const VPlacedVolume* daughter : volume->GetDaughters())
      sum += touchables(detector, *daughter);
    known = sum;
    return sum;
  }

  /// Numbers the tree in preorder: a volume itself counts one, an assembly counts none.
  void number_daughters(Paths& paths, const Detector& detector, const LogicalVolume& volume,
                        TouchableId next) {
    for (const VPlacedVolume* placed : volume.GetDaughters()) {
      if (empty_.contains(placed->GetLogicalVolume())) continue;
      const auto found = volumes_.find(placed->GetLogicalVolume());
      number(paths, *placed, next, found == volumes_.end() ? VolumeId{0} : found->second);
      next += touchables(detector, *placed);
    }
  }
  static void number(Paths& paths, const VPlacedVolume& placed, TouchableId offset,
                     VolumeId volume) {
    if (placed.id() >= paths.nodes.size()) paths.nodes.resize(placed.id() + 1);
    Paths::Node& node = paths.nodes[placed.id()];
    const Paths::Node made{offset, volume, !placed.IsAssembly()};
    if (node.level && node.offset != made.offset)
      throw GeometryError("VecGeom's placed volume '" + placed.GetLabel() +
                          "' is the daughter of two volumes: place its volume twice");
    node = made;
  }

  double mm_;
  const MaterialOf& material_;
  DetectorBuilder builder_;
  std::optional<DetectorBuilder::MaterialId> placeholder_;
  std::unordered_map<const LogicalVolume*, VolumeId> volumes_;
  std::unordered_set<const LogicalVolume*> empty_;
  std::unordered_map<const LogicalVolume*, std::optional<TouchableId>> assemblies_;
  std::vector<std::vector<Way>> ways_;  ///< by volume and daughter
};

}  // namespace

ConvertedWorld convert(const VPlacedVolume& world, double mm, const MaterialOf& material) {
  return Conversion(mm, material).convert(world);
}

}  // namespace navjit::vecgeom
