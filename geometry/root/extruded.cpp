// TGeoXtru: a polygon along sections, which may form steps.
#include "geometry/root/composites.hpp"
#include "geometry/solids/extruded_steps.hpp"

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
  std::vector<ExtrudedSection> all;
  for (std::size_t i = 0; i < sections; ++i) {
    all.push_back({cm * z[i], cm * x0[i], cm * y0[i], scale[i]});
  }
  const std::vector<std::vector<ExtrudedSection>> bodies = bodies_between_steps(all);
  MadeSolid made{make_extruded(s.name, polygon, bodies.front())};
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    made = combine(reading, s, Boolean::join, {made.solid, made.size},
                   {make_extruded(s.name, polygon, bodies[i])});
  }
  return made;
}

}  // namespace navjit::root
