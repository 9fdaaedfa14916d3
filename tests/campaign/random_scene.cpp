#include "tests/campaign/random_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

#include "geometry/model/random.hpp"
#include "geometry/model/transformation.hpp"
#include "navjit/vector.hpp"

namespace navjit::campaign {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_world = 100;  // mm

/// Writes the solids of one file. Every solid fits into a sphere of the given radius about its
/// origin.
class Writer {
 public:
  Writer(std::uint64_t seed, bool inverse_booleans)
      : random_(seed), inverse_booleans_(inverse_booleans) {}

  double any(double low, double high) { return uniform(random_, low, high); }
  bool chance(double p) { return any(0, 1) < p; }
  std::size_t below(std::size_t n) { return random_() % n; }
  Vec3 direction() { return unit_vector(random_); }

  using Attributes = std::initializer_list<std::pair<const char*, double>>;

  /// Elements `inner` are written within.
  void solid(const char* tag, const std::string& name, const Attributes& attributes,
             const std::string& inner = "") {
    text += std::string("<") + tag + " name=\"" + name + "\"" + list(attributes) +
            (attributes.size() > 0 ? " lunit=\"mm\" aunit=\"rad\">" : ">") + inner + "</" + tag +
            ">\n";
  }
  static std::string list(const Attributes& attributes) {
    std::string out;
    for (const auto& [key, value] : attributes) {
      char number[40];
      std::snprintf(number, sizeof number, "%.17g", value);
      out += std::string(" ") + key + "=\"" + number + "\"";
    }
    return out;
  }
  static std::string vector(const char* tag, const std::string& name, const Vec3& v,
                            const char* unit) {
    return std::string("<") + tag + " name=\"" + name + "\"" +
           list({{"x", v.x}, {"y", v.y}, {"z", v.z}}) + " unit=\"" + unit + "\"/>";
  }

  /// Half lengths of a box in the sphere.
  Vec3 half_lengths(double r) {
    for (;;) {
      const Vec3 u = direction();
      const Vec3 h{std::abs(u.x), std::abs(u.y), std::abs(u.z)};
      if (std::min({h.x, h.y, h.z}) > 0.2) return r * h;
    }
  }
  /// Radius and half length of a cylinder in the sphere.
  std::pair<double, double> cylinder(double r) {
    const double angle = any(0.3, 1.2);
    return {r * std::cos(angle), r * std::sin(angle)};
  }
  std::pair<double, double> segment() {
    if (chance(0.5)) return {0, 2 * pi};
    return {any(0, 2 * pi), any(0.3, 6)};
  }
  Vec3 angles() { return {any(-pi, pi), any(-pi, pi), any(-pi, pi)}; }

  /// Of the second solid of a boolean.
  Vec3 boolean_angles() {
    const Vec3 a = angles();
    if (!inverse_booleans_) return a;
    double r[9];  // its transpose turns back
    rotation_from_angles(a.x, a.y, a.z, r);
    return {std::atan2(r[5], r[8]), std::atan2(-r[2], std::hypot(r[0], r[1])),
            std::atan2(r[1], r[0])};
  }

  /// z, rmin and rmax of the planes of a polycone within a cylinder.
  std::string planes(double r, double hz) {
    const int count = 2 + static_cast<int>(below(4));
    const double bore = chance(0.5) ? 0.5 : 0;
    std::string out;
    for (int i = 0; i < count; ++i) {
      const double z = -hz + 2 * hz * i / (count - 1);
      out += "<zplane" +
             list({{"z", z}, {"rmin", bore * r * any(0.2, 0.9)}, {"rmax", r * any(0.5, 1)}}) + "/>";
    }
    return out;
  }

  std::string text;

 private:
  std::mt19937_64 random_;
  bool inverse_booleans_;
};

using Make = std::function<void(Writer&, const std::string&, double)>;
struct Kind {
  std::string name;
  Make make;
  double core;  ///< radius of a sphere about the origin in the solid, as part of r; 0: unknown
};

void make_part(Writer& w, const std::string& name, double r) {
  const auto [rho, hz] = w.cylinder(r);
  if (w.chance(0.4)) {
    const Vec3 h = w.half_lengths(r);
    w.solid("box", name, {{"x", 2 * h.x}, {"y", 2 * h.y}, {"z", 2 * h.z}});
  } else if (w.chance(0.7)) {
    w.solid("tube", name,
            {{"rmin", w.chance(0.5) ? 0 : rho / 2},
             {"rmax", rho},
             {"z", 2 * hz},
             {"startphi", 0},
             {"deltaphi", 2 * pi}});
  } else {
    w.solid("orb", name, {{"r", r}});
  }
}

/// The origin of the second solid is up to `apart` r away from that of the first.
Make boolean(const char* tag, double apart) {
  return [tag, apart](Writer& w, const std::string& name, double r) {
    make_part(w, name + "_a", 0.7 * r);
    make_part(w, name + "_b", 0.6 * r);
    const Vec3 at = (apart * r) * w.direction();
    w.solid(tag, name, {},
            "<first ref=\"" + name + "_a\"/><second ref=\"" + name + "_b\"/>" +
                Writer::vector("position", name + "_at", at, "mm") +
                Writer::vector("rotation", name + "_turn", w.boolean_angles(), "rad"));
  };
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"box",
       [](Writer& w, const std::string& name, double r) {
         const Vec3 h = w.half_lengths(r);
         w.solid("box", name, {{"x", 2 * h.x}, {"y", 2 * h.y}, {"z", 2 * h.z}});
       },
       0.2},
      {"tube",
       [](Writer& w, const std::string& name, double r) {
         const auto [rho, hz] = w.cylinder(r);
         const auto [start, delta] = w.segment();
         const double rmin = w.chance(0.4) ? 0 : rho * w.any(0.2, 0.9);
         w.solid("tube", name,
                 {{"rmin", rmin},
                  {"rmax", rho},
                  {"z", 2 * hz},
                  {"startphi", start},
                  {"deltaphi", delta}});
       },
       0},
      {"cone",
       [](Writer& w, const std::string& name, double r) {
         const auto [rho, hz] = w.cylinder(r);
         const auto [start, delta] = w.segment();
         const double a = rho * w.any(0.4, 1), b = rho * w.any(0.4, 1);
         const double bore = w.chance(0.5) ? 0 : w.any(0.2, 0.8);
         w.solid("cone", name,
                 {{"rmin1", bore * a},
                  {"rmax1", a},
                  {"rmin2", bore * b},
                  {"rmax2", b},
                  {"z", 2 * hz},
                  {"startphi", start},
                  {"deltaphi", delta}});
       },
       0},
      {"trd",
       [](Writer& w, const std::string& name, double r) {
         const Vec3 h = w.half_lengths(r);
         w.solid("trd", name,
                 {{"x1", 2 * h.x * w.any(0.3, 1)},
                  {"x2", 2 * h.x},
                  {"y1", 2 * h.y},
                  {"y2", 2 * h.y * w.any(0.3, 1)},
                  {"z", 2 * h.z}});
       },
       0.1},
      {"para",
       [](Writer& w, const std::string& name, double r) {
         const double s = 0.35 * r;
         w.solid("para", name,
                 {{"x", 2 * s * w.any(0.4, 1)},
                  {"y", 2 * s * w.any(0.4, 1)},
                  {"z", 2 * s * w.any(0.4, 1)},
                  {"alpha", w.any(-0.6, 0.6)},
                  {"theta", w.any(0, 0.6)},
                  {"phi", w.any(0, 6)}});
       },
       0},
      {"orb",
       [](Writer& w, const std::string& name, double r) {
         w.solid("orb", name, {{"r", r}});
       },
       0.95},
      {"sphere",
       [](Writer& w, const std::string& name, double r) {
         const auto [start, delta] = w.segment();
         const bool cut = w.chance(0.5);
         const double theta = cut ? w.any(0.1, 1.4) : 0;
         w.solid("sphere", name,
                 {{"rmin", w.chance(0.4) ? 0 : r * w.any(0.2, 0.95)},
                  {"rmax", r},
                  {"startphi", start},
                  {"deltaphi", delta},
                  {"starttheta", theta},
                  {"deltatheta", cut ? w.any(0.3, pi - theta) : pi}});
       },
       0},
      {"torus",
       [](Writer& w, const std::string& name, double r) {
         const double ring = r * w.any(0.55, 0.8), rmax = 0.99 * (r - ring);
         const auto [start, delta] = w.segment();
         w.solid("torus", name,
                 {{"rmin", w.chance(0.5) ? 0 : rmax * w.any(0.2, 0.9)},
                  {"rmax", rmax},
                  {"rtor", ring},
                  {"startphi", start},
                  {"deltaphi", delta}});
       },
       0},
      {"polycone",
       [](Writer& w, const std::string& name, double r) {
         const auto [rho, hz] = w.cylinder(r);
         const auto [start, delta] = w.segment();
         w.solid("polycone", name, {{"startphi", start}, {"deltaphi", delta}}, w.planes(rho, hz));
       },
       0},
      {"polyhedra",
       [](Writer& w, const std::string& name, double r) {
         const auto [rho, hz] = w.cylinder(r);
         const auto [start, delta] = w.segment();
         const auto sides = static_cast<double>(4 + w.below(6));
         w.solid("polyhedra", name, {{"startphi", start}, {"deltaphi", delta}, {"numsides", sides}},
                 w.planes(rho * std::cos(delta / (2 * sides)), hz));
       },
       0},
      {"hype",
       [](Writer& w, const std::string& name, double r) {
         const double hz = r * w.any(0.3, 0.6), outer = w.any(0.1, 0.6);
         const double rmax = r * w.any(0.3, 0.5), rmin = rmax * w.any(0.2, 0.8);
         w.solid("hype", name,
                 {{"rmin", rmin},
                  {"rmax", rmax},
                  {"inst", outer * w.any(0.1, 0.9)},
                  {"outst", outer},
                  {"z", 2 * hz}});
       },
       0},
      {"paraboloid",
       [](Writer& w, const std::string& name, double r) {
         const auto [rho, hz] = w.cylinder(r);
         w.solid("paraboloid", name, {{"rlo", rho * w.any(0, 0.7)}, {"rhi", rho}, {"dz", hz}});
       },
       0},
      {"ellipsoid",
       [](Writer& w, const std::string& name, double r) {
         const double c = r * w.any(0.4, 1);
         w.solid("ellipsoid", name,
                 {{"ax", r * w.any(0.3, 1)},
                  {"by", r * w.any(0.3, 1)},
                  {"cz", c},
                  {"zcut1", -c * w.any(0.1, 1)},
                  {"zcut2", c * w.any(0.1, 1)}});
       },
       0},
      {"eltube",
       [](Writer& w, const std::string& name, double r) {
         const auto [rho, hz] = w.cylinder(r);
         w.solid("eltube", name, {{"dx", rho * w.any(0.3, 1)}, {"dy", rho}, {"dz", hz}});
       },
       0},
      {"cutTube",
       [](Writer& w, const std::string& name, double r) {
         const double rho = 0.4 * r, hz = 0.4 * r;
         const auto [start, delta] = w.segment();
         const double a = w.any(0, 0.6), b = w.any(0, 0.6), phi = w.any(0, 6), psi = w.any(0, 6);
         w.solid("cutTube", name,
                 {{"rmin", w.chance(0.4) ? 0 : rho * w.any(0.2, 0.9)},
                  {"rmax", rho},
                  {"z", 2 * hz},
                  {"startphi", start},
                  {"deltaphi", delta},
                  {"lowX", std::sin(a) * std::cos(phi)},
                  {"lowY", std::sin(a) * std::sin(phi)},
                  {"lowZ", -std::cos(a)},
                  {"highX", std::sin(b) * std::cos(psi)},
                  {"highY", std::sin(b) * std::sin(psi)},
                  {"highZ", std::cos(b)}});
       },
       0},
      {"union", boolean("union", 0.4), 0},
      {"subtraction", boolean("subtraction", 0.4), 0},
      {"intersection", boolean("intersection", 0.1), 0},
  };
  return all;
}

const Kind& kind_called(const std::string& name) {
  for (const Kind& kind : kinds()) {
    if (kind.name == name) return kind;
  }
  throw std::invalid_argument("no solids are of kind '" + name + "'");
}

std::string volume(const std::string& name, const std::string& inner) {
  return "<volume name=\"" + name + "\"><materialref ref=\"Vacuum\"/><solidref ref=\"" + name +
         "_solid\"/>" + inner + "</volume>\n";
}

std::string placed(Writer& w, const std::string& name, const Vec3& at) {
  return "\n<physvol name=\"" + name + "_placed\"><volumeref ref=\"" + name + "\"/>" +
         Writer::vector("position", name + "_position", at, "mm") +
         Writer::vector("rotation", name + "_rotation", w.angles(), "rad") + "</physvol>";
}

}  // namespace

const std::vector<std::string>& scene_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Kind& kind : kinds()) list.push_back(kind.name);
    return list;
  }();
  return names;
}

std::string random_scene(std::uint64_t seed, int solids, const std::vector<std::string>& names,
                         bool inverse_booleans) {
  struct Ball {
    Vec3 centre;
    double radius;
  };
  Writer w(seed, inverse_booleans);
  std::vector<Ball> balls;
  std::string structure, daughters;
  int number = 0;
  for (int attempt = 0; attempt < 50 * solids && static_cast<int>(balls.size()) < solids;
       ++attempt) {
    const double r = w.any(4, 16), room = half_world - r;
    const Ball ball{{w.any(-room, room), w.any(-room, room), w.any(-room, room)}, r};
    if (std::any_of(balls.begin(), balls.end(), [&](const Ball& other) {
          return norm(other.centre - ball.centre) < other.radius + r;
        })) {
      continue;
    }
    balls.push_back(ball);
    const Kind& kind = kind_called(names[w.below(names.size())]);
    const std::string name = kind.name + "_" + std::to_string(number++);
    kind.make(w, name + "_solid", 0.999 * r);
    std::string inner;
    if (kind.core > 0 && w.chance(0.6)) {
      const Kind& core = kind_called(names[w.below(names.size())]);
      const std::string core_name = core.name + "_" + std::to_string(number++);
      core.make(w, core_name + "_solid", 0.99 * kind.core * r);
      structure += volume(core_name, "");
      inner = placed(w, core_name, {0, 0, 0});
    }
    structure += volume(name, inner);
    daughters += placed(w, name, ball.centre);
  }
  const double full = 2 * half_world;
  w.solid("box", "world_solid", {{"x", full}, {"y", full}, {"z", full}});
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gdml>\n<define/>\n<materials>\n"
         "<material name=\"Vacuum\" Z=\"1\"><D value=\"1e-25\" unit=\"g/cm3\"/>"
         "<atom value=\"1.008\"/></material>\n</materials>\n<solids>\n" +
         w.text + "</solids>\n<structure>\n" + structure + volume("world", daughters) +
         "</structure>\n<setup name=\"Default\" version=\"1.0\"><world ref=\"world\"/></setup>\n"
         "</gdml>\n";
}

}  // namespace navjit::campaign
