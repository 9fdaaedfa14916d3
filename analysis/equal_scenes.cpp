#include "analysis/equal_scenes.hpp"

#include <string>
#include <type_traits>
#include <unordered_map>

#include "geometry/solids/fields.hpp"

namespace navjit {
namespace {

/// Appends values byte by byte: equal keys, equal scenes.
struct Key {
  std::string bytes{};

  template <class Value>
  void add(const Value& value) {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value> || std::is_pointer_v<Value>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Field>
  void operator()(const char*, const Field& field) {
    if constexpr (std::is_arithmetic_v<Field>) {
      add(field);
    } else {
      visit_fields(field, *this);
    }
  }
  template <class Field>
  void operator()(const char*, const Field* fields, int count) {
    add(count);
    for (int i = 0; i < count; ++i) (*this)("", fields[i]);
  }
};

void add_solid(Key& key, const kernels::AnySolid<double>& solid) {
  key.add(solid.kind);
  kernels::visit(solid, [&](const auto& shape) {
    if constexpr (requires { visit_fields(shape, key); }) {
      visit_fields(shape, key);
    } else {
      key.add(solid.shape);  // solids made of solids: only if they are one and the same
    }
  });
}

std::string key_of(const Geometry& geometry, const WorldFacts& facts, VolumeId volume) {
  Key key;
  const Scene& scene = geometry.scene(volume);
  add_solid(key, scene.solid);
  const FrameFacts& frame = facts.frames[volume];
  key.add(frame.never_rotated);
  key.add(frame.only_rotation.has_value());
  if (frame.only_rotation) {
    for (const double r : *frame.only_rotation) key.add(r);
  }
  key.add(facts.only_mothers[volume].value_or(~VolumeId{0}));
  key.add(volume == geometry.world().top);
  for (const Daughter& d : scene.daughters) {
    key.add(d.volume);
    key.add(d.offset);
    for (const double t : d.transformation.translation) key.add(t);
    for (const double r : d.transformation.rotation) key.add(r);
  }
  return std::move(key.bytes);
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
