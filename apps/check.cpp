// `navjit check`: overlaps and protrusions.
#include <cstdio>

#include "apps/commands.hpp"
#include "apps/read_detector.hpp"
#include "geometry/check/overlaps.hpp"

namespace navjit::apps {

int check(const CheckOptions& options) {
  const Geometry geometry(read_detector(options.detector, options.setup));
  OverlapOptions overlap_options;
  overlap_options.resolution = options.resolution;
  overlap_options.tolerance = options.tolerance;
  const std::vector<Overlap> overlaps = find_overlaps(geometry, overlap_options);
  const World& world = geometry.world();
  for (const Overlap& o : overlaps) {
    const LogicalVolume& mother = world.volumes[o.volume];
    const auto name = [&](std::uint32_t k) {
      const Placement& p = mother.daughters[k];
      return (p.name.empty() ? world.volumes[p.volume].name : p.name) + " (number " +
             std::to_string(k) + ")";
    };
    const bool sticks_out = o.second == Overlap::mother;
    std::printf("%s: %s %s%s by at least %.6g mm at %.9g,%.9g,%.9g\n", mother.name.c_str(),
                name(o.first).c_str(), sticks_out ? "sticks out of it" : "overlaps ",
                sticks_out ? "" : name(o.second).c_str(), o.depth, o.point.x, o.point.y, o.point.z);
  }
  std::printf("%zu overlaps and protrusions deeper than %g mm, %zu points a daughter\n",
              overlaps.size(), options.tolerance, options.resolution);
  return overlaps.empty() ? 0 : 1;
}

}  // namespace navjit::apps
