#include "runtime/fingerprint.hpp"

#include <type_traits>

#include "analysis/solid_key.hpp"
#include "cache/sha256.hpp"

namespace navjit {
namespace {

template <class Value>
void add(std::string& bytes, const Value& value) {
  static_assert(std::is_arithmetic_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void add_text(std::string& bytes, const std::string& text) {
  add(bytes, text.size());
  bytes += text;
}

/// Adds everything that determines the solid. solid_key() is not sufficient: it distinguishes
/// scaled and foreign solids only by their addresses, which differ from run to run.
void add_solid(std::string& bytes, const kernels::AnySolid<double>& solid) {
  add(bytes, static_cast<int>(solid.kind));
  kernels::visit(solid, [&](const auto& shape) {
    if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, kernels::ForeignShape>) {
      add_text(bytes, shape.solid->key());
    } else if constexpr (requires { shape.inverse_x; }) {
      for (const double x : {shape.inverse_x, shape.inverse_y, shape.inverse_z}) add(bytes, x);
      add_solid(bytes, shape.solid);
    } else if constexpr (requires { shape.a, shape.b; }) {
      add_solid(bytes, shape.a.solid);
      add_solid(bytes, shape.b.solid);
    } else if constexpr (requires { shape.solid, shape.translation, shape.rotation; }) {
      for (const double t : shape.translation) add(bytes, t);
      for (const double r : shape.rotation) add(bytes, r);
      add_solid(bytes, shape.solid);
    } else {
      add_text(bytes, solid_key(solid));
    }
  });
}

}  // namespace

std::string geometry_fingerprint(const Geometry& geometry) {
  const World& world = geometry.world();
  std::string bytes;
  add(bytes, world.top);
  add(bytes, world.tolerance);
  add(bytes, geometry.size());
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    const Scene& scene = geometry.scene(v);
    add_text(bytes, world.volumes[v].name);
    add_solid(bytes, scene.solid);
    add(bytes, scene.daughters.size());
    for (const Daughter& d : scene.daughters) {
      add(bytes, d.volume);
      add(bytes, d.offset);
      for (const double t : d.transformation.translation) add(bytes, t);
      for (const double r : d.transformation.rotation) add(bytes, r);
    }
  }
  return cache::hex(cache::sha256({bytes}));
}

}  // namespace navjit
