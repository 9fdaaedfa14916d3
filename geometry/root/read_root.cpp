// Reads a detector from a file: finds the object to read, and makes the world around it.
#include <algorithm>

#include "geometry/model/placed_extent.hpp"
#include "geometry/printable.hpp"
#include "geometry/root/container.hpp"
#include "geometry/root/layouts.hpp"
#include "geometry/root/reading.hpp"

namespace navjit {
namespace root {
namespace {

bool is_volume(const Key& key) {
  return key.type == "TGeoVolume" || key.type == "TGeoVolumeAssembly" ||
         key.type == "TGeoVolumeMulti";
}

const Key& choose(const std::vector<Key>& keys, const std::string& wanted) {
  const auto find = [&](auto&& fits) {
    return std::ranges::find_if(
        keys, [&](const Key& key) { return fits(key) && (wanted.empty() || key.name == wanted); });
  };
  auto found = find([](const Key& key) { return key.type == "TGeoManager"; });
  if (found == keys.end()) found = find(is_volume);
  if (found != keys.end()) return *found;
  std::string known;
  int listed = 0;
  for (const Key& key : keys) {
    if (key.type != "TGeoManager" && !is_volume(key)) continue;
    if (++listed <= 10) known += (known.empty() ? "'" : ", '") + printable(key.name) + "'";
  }
  if (known.empty()) {
    throw FormatError(
        "there is no geometry (TGeoManager) in it; write one with "
        "gGeoManager->Export(\"FILE.root\")");
  }
  throw FormatError("there is no geometry '" + printable(wanted) + "'; choose one of " + known);
}

/// If the top has no solid of its own, the world is a box around what is in it.
VolumeId world_about(Reading& reading, const Object& volume, const MadeVolume& made) {
  if (!made.assembly) return made.id;
  if (made.placements.empty()) volume.fail("it is empty");
  LogicalVolume box;
  const Vec3 half = half_lengths_around(reading.world, made.placements);
  box.name = volume.name;
  box.solid = make_box(volume.name, 1.1 * half.x, 1.1 * half.y, 1.1 * half.z);
  box.material = read_material(reading, 0);
  box.daughters = made.placements;
  reading.notes.count("the top volume is an assembly: it is in a box without material");
  reading.world.volumes.push_back(std::move(box));
  return static_cast<VolumeId>(reading.world.volumes.size() - 1);
}

World read_unchecked(const std::filesystem::path& path, const RootOptions& options,
                     GdmlReport* report) {
  Container file(path, options.limits);
  const Key& key = choose(file.keys(), options.key);
  const Layouts layouts(file);
  Objects objects(file.object(key), key, layouts);
  Reading reading{objects, options.limits};
  Reference top = own_object;
  if (key.type == "TGeoManager") {
    top = objects.at(own_object).reference("fMasterVolume");
    if (top == 0) objects.at(own_object).fail("it has no master volume; close the geometry first");
  }
  reading.world.top = world_about(reading, objects.at(top), read_volume(reading, top));
  finish(reading.world);
  if (report != nullptr) reading.notes.tell(*report);
  return std::move(reading.world);
}

}  // namespace
}  // namespace root

Detector read_root(const std::filesystem::path& path, const RootOptions& options,
                   GdmlReport* report) {
  try {
    return Detector(root::read_unchecked(path, options, report));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw RootError(printable_path(path.string()) + ": " + printable(e.what(), 2000));
  }
}

}  // namespace navjit
