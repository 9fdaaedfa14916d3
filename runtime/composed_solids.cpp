#include "runtime/composed_solids.hpp"

#include <map>
#include <string>

#include "analysis/solid_key.hpp"
#include "codegen/data/library_solids.hpp"
#include "codegen/solids.hpp"
#include "runtime/schedule.hpp"

namespace navjit {
namespace {

/// A solid that is expected to take longer is not compiled, because everything else would wait for
/// it.
constexpr double most_solid_ms = 1000;

/// The shares of a step in a mother that its own solid takes, and all its daughters. Guesses.
constexpr double share_of_mother = 0.3, share_of_daughters = 0.6;

struct Found {
  std::vector<ComposedSolid> solids{};
  std::map<const void*, std::size_t> by_shape{};
  std::map<std::string, std::size_t> by_key{};

  void add(const kernels::AnySolid<double>& solid, const Extent& extent, ComposedSolid::In in) {
    if (!codegen::gains_from_code(solid)) return;
    const auto [at, is_new] = by_shape.try_emplace(solid.shape, solids.size());
    if (is_new) {
      const auto [same, is_first] = by_key.try_emplace(solid_key(solid), solids.size());
      at->second = same->second;
      if (is_first) {
        ComposedSolid& fresh = solids.emplace_back();
        fresh.solid = solid;
        fresh.extent = extent;
        fresh.compile_ms = expected_compile_ms(solid);
        fresh.in_library = codegen::is_in_library(solid);
        fresh.tried = fresh.compile_ms > most_solid_ms;
      }
      solids[at->second].shapes.push_back(solid.shape);
    }
    std::vector<ComposedSolid::In>& scenes = solids[at->second].scenes;
    if (!scenes.empty() && scenes.back().volume == in.volume) {
      scenes.back().share += in.share;
    } else {
      scenes.push_back(in);
    }
  }
};

}  // namespace

std::vector<ComposedSolid> find_composed_solids(const Geometry& geometry, const WorldFacts& facts) {
  Found found;
  for (std::size_t v = 0; v < geometry.size(); ++v) {
    if (!facts.reachable[v]) continue;
    const auto volume = static_cast<VolumeId>(v);
    const Scene& scene = geometry.scene(volume);
    const auto extent = [&](VolumeId of) { return geometry.world().volumes[of].solid.extent; };
    found.add(scene.solid, extent(volume), {volume, scene.daughters.empty() ? 1 : share_of_mother});
    const double each = share_of_daughters / static_cast<double>(scene.daughters.size());
    for (const Daughter& d : scene.daughters) found.add(d.solid, extent(d.volume), {volume, each});
  }
  return std::move(found.solids);
}

}  // namespace navjit
