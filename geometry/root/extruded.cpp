// TGeoXtru: a polygon along sections, which may form steps.
#include "geometry/root/composites.hpp"

namespace navjit::root {

MadeSolid read_extruded(Reading& reading, const Object& s) {
  constexpr std::size_t most = 1000, most_pairs = 200'000'000;
  const std::size_t corners = s.count("fNvert", most), sections = s.count("fNz", most);
  const std::span<const double> x = s.numbers("fX", corners), y = s.numbers("fY", corners);
  const std::span<const double> z = s.numbers("fZ", sections), x0 = s.numbers("fX0", sections),
                                y0 = s.numbers("fY0", sections),
                                scale = s.numbers("fScale", sections);
  reading.corner_pairs += corners * corners;
  if (reading.corner_pairs > most_pairs) s.fail("the polygons have too many corners in all");
  std::vector<PlanarPoint> polygon;
  for (std::size_t i = 0; i < corners; ++i) polygon.push_back({cm * x[i], cm * y[i]});
  // Two sections at one z form a step: one body ends there, and another one begins.
  std::vector<std::vector<ExtrudedSection>> bodies(1);
  for (std::size_t i = 0; i < sections; ++i) {
    if (i > 0 && z[i] == z[i - 1]) {
      if (x0[i] == x0[i - 1] && y0[i] == y0[i - 1] && scale[i] == scale[i - 1]) continue;
      bodies.emplace_back();
    }
    bodies.back().push_back({cm * z[i], cm * x0[i], cm * y0[i], scale[i]});
  }
  MadeSolid made{make_extruded(s.name, polygon, bodies.front())};
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    made = combine(reading, s, Boolean::join, {made.solid, made.size},
                   {make_extruded(s.name, polygon, bodies[i])});
  }
  return made;
}

}  // namespace navjit::root
