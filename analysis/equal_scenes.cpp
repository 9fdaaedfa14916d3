#include "analysis/equal_scenes.hpp"

#include <string>
#include <unordered_map>

#include "analysis/solid_key.hpp"

namespace navjit {
namespace {

template <class Value>
void add(std::string& key, const Value& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string key_of(const Geometry& geometry, const WorldFacts& facts, VolumeId volume) {
  const Scene& scene = geometry.scene(volume);
  std::string key = solid_key(scene.solid);
  const FrameFacts& frame = facts.frames[volume];
  add(key, frame.never_rotated);
  add(key, frame.only_rotation.has_value());
  if (frame.only_rotation) {
    for (const double r : *frame.only_rotation) add(key, r);
  }
  add(key, facts.only_mothers[volume].value_or(~VolumeId{0}));
  add(key, volume == geometry.world().top);
  for (const Daughter& d : scene.daughters) {
    add(key, d.volume);
    add(key, d.offset);
    for (const double t : d.transformation.translation) add(key, t);
    for (const double r : d.transformation.rotation) add(key, r);
  }
  return key;
}

}  // namespace

std::vector<VolumeId> equal_scenes(const Geometry& geometry, const WorldFacts& facts) {
  std::vector<VolumeId> first(geometry.size());
  std::unordered_map<std::string, VolumeId> known;
  for (VolumeId v = 0; v < first.size(); ++v) {
    first[v] = facts.reachable[v] ? known.emplace(key_of(geometry, facts, v), v).first->second : v;
  }
  return first;
}

}  // namespace navjit
