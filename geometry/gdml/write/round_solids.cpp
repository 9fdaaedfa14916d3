// Writes solids about the z axis.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/gdml/write/solids.hpp"
#include "geometry/solids/make.hpp"

namespace navjit::gdml {
namespace {

using Face = kernels::ConicalFace<double>;
using Section = kernels::Section<double>;

double radius(const Face& face, double z) {
  return std::max(0.0, (face.radius + face.slope * z) / face.cosine);
}

/// Rings along z, each touching the next: they are the planes of one polycone.
struct Chain {
  std::vector<ZPlane> planes;
};

bool nearly(double a, double b) { return std::abs(a - b) <= 1e-13 * (std::abs(a) + std::abs(b)); }

/// A contour that turns back in z has several rings at one height: it becomes several chains.
std::vector<Chain> chains_of(const Section* sections, int count) {
  std::vector<Chain> chains;
  for (int i = 0; i < count; ++i) {
    const Section& s = sections[i];
    const double length = s.z_high - s.z_low;
    const auto plane = [&](double z) {
      const double outer = radius(s.outer, z);
      const double inner = s.bored != 0 ? std::min(radius(s.inner, z), outer) : 0;
      return ZPlane{z == 0 ? s.z_low : s.z_high, inner, outer};
    };
    const ZPlane low = plane(0), high = plane(length);
    const auto goes_on = std::find_if(chains.begin(), chains.end(), [&](const Chain& chain) {
      const ZPlane& last = chain.planes.back();
      return last.z == low.z && last.rmin <= low.rmax && low.rmin <= last.rmax;
    });
    Chain& chain = goes_on != chains.end() ? *goes_on : chains.emplace_back();
    const bool same = !chain.planes.empty() && nearly(chain.planes.back().rmin, low.rmin) &&
                      nearly(chain.planes.back().rmax, low.rmax);
    if (!same) chain.planes.push_back(low);
    chain.planes.push_back(high);
  }
  return chains;
}

/// Writes each chain by `write(name, planes)`, and their union if there are several.
template <class Write>
void write_chains(SolidWriter& out, const std::string& name, const std::vector<Chain>& chains,
                  const Write& write) {
  const auto part = [&](std::size_t i) {
    std::string own = out.own_name(name + "_part" + std::to_string(i));
    write(own, chains[i].planes);
    return own;
  };
  if (chains.size() == 1) return write(name, chains[0].planes);
  std::string all = part(0);
  for (std::size_t i = 1; i < chains.size(); ++i) {
    const std::string next = part(i);
    const bool last = i + 1 == chains.size();
    const std::string sum = last ? name : out.own_name(name + "_sum" + std::to_string(i));
    out.write("union", sum, "",
              "<first" + attribute("ref", all) + "/><second" + attribute("ref", next) + "/>");
    all = sum;
  }
}

std::string planes_text(const std::vector<ZPlane>& planes) {
  std::string text;
  for (const ZPlane& p : planes) {
    text += "<zplane" + attributes({{"rmin", p.rmin}, {"rmax", p.rmax}, {"z", p.z}}) + "/>";
  }
  return text;
}

/// The polar angle of a limiting cone, which is the nappe about +z or that about -z.
double polar_angle(const Face& face, bool upper) {
  return upper ? std::atan2(face.slope, face.cosine) : std::atan2(-face.slope, -face.cosine);
}

}  // namespace

void write_shape(SolidWriter& out, const std::string& name, const kernels::Tube<double>& s) {
  out.write("tube", name,
            attributes({{"rmin", s.rmin}, {"rmax", s.rmax}, {"z", 2 * s.hz}}) +
                wedge_text(s.wedge) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::CutTube<double>& s) {
  // Both end planes cross the axis at the same distance from the origin.
  out.write("cutTube", name,
            attributes({{"rmin", s.rmin},
                        {"rmax", s.rmax},
                        {"z", -2 * s.high.d / s.high.c},
                        {"lowX", s.low.a},
                        {"lowY", s.low.b},
                        {"lowZ", s.low.c},
                        {"highX", s.high.a},
                        {"highY", s.high.b},
                        {"highZ", s.high.c}}) +
                wedge_text(s.wedge) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Cone<double>& s) {
  const double rmax1 = radius(s.outer, -s.hz), rmax2 = radius(s.outer, s.hz);
  const double rmin1 = s.bored != 0 ? std::min(radius(s.inner, -s.hz), rmax1) : 0;
  const double rmin2 = s.bored != 0 ? std::min(radius(s.inner, s.hz), rmax2) : 0;
  out.write("cone", name,
            attributes({{"rmin1", rmin1},
                        {"rmax1", rmax1},
                        {"rmin2", rmin2},
                        {"rmax2", rmax2},
                        {"z", 2 * s.hz}}) +
                wedge_text(s.wedge) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Orb<double>& s) {
  out.write("orb", name, attributes({{"r", s.radius}}) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Sphere<double>& s) {
  const double low = s.low.kind == 0 ? 0 : polar_angle(s.low.face, s.low.kind == 2);
  const double high =
      s.high.kind == 0 ? std::numbers::pi : polar_angle(s.high.face, s.high.kind == 1);
  out.write(
      "sphere", name,
      attributes(
          {{"rmin", s.rmin}, {"rmax", s.rmax}, {"starttheta", low}, {"deltatheta", high - low}}) +
          wedge_text(s.wedge) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Torus<double>& s) {
  out.write("torus", name,
            attributes({{"rmin", s.rmin}, {"rmax", s.rmax}, {"rtor", s.rtor}}) +
                wedge_text(s.wedge) + in_mm());
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Polycone<double>& s) {
  write_chains(out, name, chains_of(s.sections, s.count),
               [&](const std::string& own, const std::vector<ZPlane>& planes) {
                 out.write("polycone", own, wedge_text(s.wedge) + in_mm(), planes_text(planes));
               });
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::Polyhedra<double>& s) {
  const double angle = navjit::detail::angle_of(s.wedge);
  const double start = s.wedge.kind != 0
                           ? std::atan2(s.wedge.start_y, s.wedge.start_x)
                           : std::atan2(s.sides[0].y, s.sides[0].x) - angle / (2 * s.side_count);
  write_chains(out, name, chains_of(s.sections, s.count),
               [&](const std::string& own, const std::vector<ZPlane>& planes) {
                 out.write("polyhedra", own,
                           attributes({{"startphi", start}, {"deltaphi", angle}}) + in_rad() +
                               attribute("numsides", std::to_string(s.side_count)) + in_mm(),
                           planes_text(planes));
               });
}

void write_shape(SolidWriter& out, const std::string& name, const kernels::TwistedTube<double>& s) {
  const double half = std::max(std::abs(s.z_low), std::abs(s.z_high));
  const double twist = 2 * std::atan(s.start.kappa * half);
  const double rmin = std::sqrt(-s.inner.e), rmax = std::sqrt(-s.outer.e);
  const double phi = 2 * std::atan2(-s.start.nx, -s.start.ny);
  const std::string common = attributes({{"twistedangle", twist}, {"phi", phi}});
  if (s.z_low == -s.z_high) {
    const double waist = std::cos(twist / 2);
    out.write("twistedtubs", name,
              common +
                  attributes({{"endinnerrad", rmin / waist},
                              {"endouterrad", rmax / waist},
                              {"zlen", 2 * half}}) +
                  in_rad() + in_mm());
  } else {
    out.write("twistedtubs", name,
              common +
                  attributes({{"midinnerrad", rmin},
                              {"midouterrad", rmax},
                              {"negativeEndz", s.z_low},
                              {"positiveEndz", s.z_high}}) +
                  in_rad() + in_mm());
  }
}

void write_quadric(SolidWriter& out, const std::string& name, SolidKind kind,
                   const kernels::QuadricSolid<double>& s) {
  const kernels::Quadric<double>& f = s.outer;
  const double a = 1 / std::sqrt(f.a), b = 1 / std::sqrt(f.b);
  switch (kind) {
    case SolidKind::ellipsoid: {
      const double c = 1 / std::sqrt(f.c);
      out.write("ellipsoid", name,
                attributes({{"ax", a},
                            {"by", b},
                            {"cz", c},
                            {"zcut1", std::max(s.z_low, -c)},
                            {"zcut2", std::min(s.z_high, c)}}) +
                    in_mm());
      break;
    }
    case SolidKind::eltube:
      out.write("eltube", name,
                attributes({{"dx", s.hx}, {"dy", s.hy}, {"dz", s.z_high}}) + in_mm());
      break;
    case SolidKind::elcone:
      out.write(
          "elcone", name,
          attributes({{"dx", a}, {"dy", b}, {"zmax", f.origin}, {"zcut", s.z_high}}) + in_mm());
      break;
    case SolidKind::paraboloid:
      out.write("paraboloid", name,
                attributes({{"rlo", std::sqrt(-f.e)}, {"rhi", s.hx}, {"dz", s.z_high}}) + in_mm());
      break;
    default: {
      const bool bored = s.bored != 0;
      out.write("hype", name,
                attributes({{"rmin", bored ? std::sqrt(-s.inner.e) : 0},
                            {"rmax", std::sqrt(-f.e)},
                            {"inst", bored ? std::atan(std::sqrt(-s.inner.c)) : 0},
                            {"outst", std::atan(std::sqrt(-f.c))},
                            {"z", 2 * s.z_high}}) +
                    in_rad() + in_mm());
    }
  }
}

}  // namespace navjit::gdml
