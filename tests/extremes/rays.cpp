#include "tests/extremes/rays.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "geometry/model/random.hpp"
#include "geometry/reference/wide_geometry.hpp"
#include "navjit/vector.hpp"

namespace navjit::extremes {
namespace {

using reference::Quad;
using Point = kernels::Vec3<Quad>;
using Wide = kernels::AnySolid<Quad>;

Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator*(Quad s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
Quad dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point unit(const Point& a) { return (1 / kernels::square_root(dot(a, a))) * a; }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Point widen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 narrow(const Point& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

Point to_outer(const Transformation& t, const Point& p) {
  const double *r = t.rotation, *c = t.translation;
  return {c[0] + r[0] * p.x + r[3] * p.y + r[6] * p.z, c[1] + r[1] * p.x + r[4] * p.y + r[7] * p.z,
          c[2] + r[2] * p.x + r[5] * p.y + r[8] * p.z};
}
Point turned_to_outer(const Transformation& t, const Point& v) {
  const double* r = t.rotation;
  return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
          r[2] * v.x + r[5] * v.y + r[8] * v.z};
}

double size_of(const Extent& e) { return norm(e.max - e.min); }

/// One of the values at random.
template <class T, std::size_t n>
const T& one_of(std::mt19937_64& random, const T (&values)[n]) {
  return values[random() % n];
}

/// A point on a daughter's surface in the world's frame, with the outward normal.
struct Contact {
  Point point, normal, along;
  double size;
};

class Surfaces {
 public:
  explicit Surfaces(const World& world) : world_(world) {}

  std::optional<Contact> random_contact(std::mt19937_64& random) {
    const auto& daughters = world_.volumes[world_.top].daughters;
    const Placement& placement = daughters[random() % daughters.size()];
    const Solid& solid = world_.volumes[placement.volume].solid;
    const Wide wide = wide_of(placement.volume);
    const double size = size_of(solid.extent);
    const Vec3 from = point_in(random, solid.extent), v = unit_vector(random);
    const auto direction = kernels::make_direction<Quad>(v.x, v.y, v.z);
    const Quad tolerance = world_.tolerance;
    const bool in = contains(wide, widen(from), direction, tolerance);
    const Quad t = in ? distance_to_out(wide, widen(from), direction, tolerance)
                      : distance_to_in(wide, widen(from), direction, tolerance);
    if (!(t < Quad(1e30))) return std::nullopt;
    const Point p = kernels::advance(widen(from), direction, t);
    const Quad h = Quad(1e-16) * size;
    const auto slope = [&](const Point& step) {
      const auto distance = [&](const Point& q) {
        return safety_to_in(wide, q) - safety_to_out(wide, q);
      };
      return distance(p + step) - distance(p + Quad(-1) * step);
    };
    const Point gradient{slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})};
    if (!(dot(gradient, gradient) > 0)) return std::nullopt;
    const Point normal = unit(gradient);
    const Point along = unit(cross(normal, widen(unit_vector(random))));
    const Transformation& frame = placement.transformation;
    return Contact{to_outer(frame, p), turned_to_outer(frame, normal),
                   turned_to_outer(frame, along), size};
  }

 private:
  Wide wide_of(VolumeId volume) {
    auto& kept = wide_[volume];
    if (!kept) kept = std::make_shared<const WideSolid<Quad>>(world_.volumes[volume].solid);
    return kept->any();
  }

  const World& world_;
  std::map<VolumeId, std::shared_ptr<const WideSolid<Quad>>> wide_;
};

template <class Make>
std::vector<Ray> from_contacts(const World& world, std::size_t count, std::uint64_t seed,
                               Make make) {
  std::mt19937_64 random(seed);
  Surfaces surfaces(world);
  std::vector<Ray> rays;
  for (std::size_t tries = 0; rays.size() < count && tries < 100 * count; ++tries) {
    if (const auto contact = surfaces.random_contact(random))
      rays.push_back(make(random, *contact));
  }
  return rays;
}

}  // namespace

std::vector<Ray> plain_rays(const World& world, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto& daughters = world.volumes[world.top].daughters;
  std::vector<Ray> rays;
  while (rays.size() < count) {
    Vec3 p;
    if (daughters.empty() || random() % 4 == 0) {
      p = point_in(random, world.volumes[world.top].solid.extent);
    } else {
      const Placement& d = daughters[random() % daughters.size()];
      p = navjit::to_outer(d.transformation,
                           point_in(random, world.volumes[d.volume].solid.extent));
    }
    const Vec3 v = unit_vector(random);
    rays.push_back({p, (1 / norm(v)) * v});
  }
  return rays;
}

std::vector<Ray> rays_on_surfaces(const World& world, std::size_t count, std::uint64_t seed) {
  return from_contacts(world, count, seed, [&](std::mt19937_64& random, const Contact& c) {
    constexpr double off[] = {0, 0, 0.3, -0.3, 0.999, -0.999, 1.001, -1.001, 3, -3, 1e3, -1e3};
    constexpr double tilt[] = {0, 1e-16, -1e-16, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9};
    const Point start = c.point + Quad(one_of(random, off) * world.tolerance) * c.normal;
    Point v = c.along + Quad(one_of(random, tilt)) * c.normal;
    if (random() % 4 == 0) v = c.normal;
    if (random() % 4 == 0) v = Quad(-1) * c.normal;
    if (random() % 4 == 0) v = widen(unit_vector(random));
    return Ray{narrow(start), narrow(unit(v))};
  });
}

std::vector<Ray> grazing_rays(const World& world, std::size_t count, std::uint64_t seed) {
  return from_contacts(world, count, seed, [&](std::mt19937_64& random, const Contact& c) {
    constexpr double part[] = {0, 1e-15, -1e-15, 1e-14, -1e-14, 1e-12, -1e-12, 1e-9, -1e-9};
    constexpr double tilt[] = {0, 0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9};
    const double back = c.size * uniform(random, 0.1, 2);
    const Point start =
        c.point + Quad(one_of(random, part) * c.size) * c.normal + Quad(-back) * c.along;
    return Ray{narrow(start), narrow(unit(c.along + Quad(one_of(random, tilt)) * c.normal))};
  });
}

const std::vector<Vec3>& odd_directions() {
  static const std::vector<Vec3> all = [] {
    constexpr double tiny = std::numeric_limits<double>::denorm_min();
    const double h = std::sqrt(0.5), third = std::sqrt(1.0 / 3);
    const double minors[] = {0.0, -0.0, tiny, -tiny, 1e-310, -1e-310, 1e-200, 1e-16, -1e-16, 1e-12};
    std::vector<Vec3> list;
    for (const double a : minors) {
      for (const double b : {0.0, -0.0, tiny, -1e-310}) {
        for (const double one : {1.0, -1.0}) {
          list.insert(list.end(), {{one, a, b}, {b, one, a}, {a, b, one}});
        }
      }
      for (const double s : {h, -h}) list.insert(list.end(), {{s, h, a}, {a, s, h}, {h, a, s}});
    }
    for (const double x : {third, -third}) {
      for (const double y : {third, -third}) {
        for (const double z : {third, -third}) list.push_back({x, y, z});
      }
    }
    return list;
  }();
  return all;
}

std::vector<Ray> rays_from_corners(const World& world, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto& daughters = world.volumes[world.top].daughters;
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Placement& d = daughters[random() % daughters.size()];
    const Extent& e = world.volumes[d.volume].solid.extent;
    const auto choose = [&](double low, double high) {
      const double values[] = {low, high, (low + high) / 2, 0.0};
      return one_of(random, values) + world.tolerance * (random() % 4 == 0 ? 0.7 : 0.0);
    };
    const Point local =
        widen({choose(e.min.x, e.max.x), choose(e.min.y, e.max.y), choose(e.min.z, e.max.z)});
    const auto& odd = odd_directions();
    Vec3 v = odd[random() % odd.size()];
    if (random() % 2 == 0) v = narrow(unit(turned_to_outer(d.transformation, widen(v))));
    rays.push_back({narrow(to_outer(d.transformation, local)), v});
  }
  return rays;
}

std::vector<Ray> rays_past_centres(const World& world, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto& daughters = world.volumes[world.top].daughters;
  constexpr double offs[] = {0, 0, 5e-324, -1e-310, 1e-200, 1e-100, 1e-20, -1e-12, 1e-11, 1e-9};
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Placement& d = daughters[random() % daughters.size()];
    const double size = size_of(world.volumes[d.volume].solid.extent);
    const auto& odd = odd_directions();
    Vec3 v = random() % 4 == 0 ? unit_vector(random) : odd[random() % odd.size()];
    if (random() % 2 == 0) v.z = 0;
    if (!(norm(v) > 0)) continue;
    v = (1 / norm(v)) * v;
    v = (1 / norm(v)) * v;
    const Vec3 centre = navjit::to_outer(d.transformation, {0, 0, 0});
    const Vec3 off{one_of(random, offs), one_of(random, offs), one_of(random, offs)};
    const double back[] = {0, 1e-300, 1e-12, 0.3 * size, size};
    const bool local = random() % 2 == 0;
    const Point direction = local ? turned_to_outer(d.transformation, widen(v)) : widen(v);
    rays.push_back({centre + off + (-one_of(random, back)) * narrow(direction), narrow(direction)});
  }
  return rays;
}

std::vector<Ray> not_quite_unit(std::vector<Ray> rays, double by) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i].direction = (i % 2 == 0 ? 1 + by : 1 - by) * rays[i].direction;
  }
  return rays;
}

}  // namespace navjit::extremes
