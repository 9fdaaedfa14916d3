// One solid of every kind that GDML has, of a size that can be chosen.
#include <cmath>

#include "tests/extremes/scene_text.hpp"

namespace navjit::extremes {
namespace {

using Text = SceneText;

std::string plane(double z, double rmin, double rmax) {
  return "<zplane" + Text::list({{"z", z}, {"rmin", rmin}, {"rmax", rmax}}) + "/>";
}

std::string contour(std::initializer_list<std::pair<double, double>> points, double s) {
  std::string out;
  for (const auto& [r, z] : points) {
    out += "<rzpoint" + Text::list({{"r", r * s}, {"z", z * s}}) + "/>";
  }
  return out;
}

/// Two solids, and the boolean of them.
void boolean(Text& scene, const char* tag, const std::string& name, double s) {
  scene.solid("box", name + "_a", {{"x", 14 * s}, {"y", 12 * s}, {"z", 13 * s}});
  scene.solid(
      "tube", name + "_b",
      {{"rmin", 0}, {"rmax", 5 * s}, {"z", 16 * s}, {"startphi", 0}, {"deltaphi", 2 * M_PI}});
  scene.raw_solid(std::string("<") + tag + " name=\"" + name + "_solid\"><first ref=\"" + name +
                  "_a_solid\"/><second ref=\"" + name + "_b_solid\"/>" +
                  Text::vector("position", name + "_at", {2 * s, -1.5 * s, 3 * s}, "mm") + "</" +
                  tag + ">\n");
}

const std::vector<SampleSolid> samples = {
    {"box", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("box", n, {{"x", 16 * s}, {"y", 12 * s}, {"z", 10 * s}});
     }},
    {"tube", true,
     [](Text& t, const std::string& n, double s) {
       t.solid(
           "tube", n,
           {{"rmin", 3 * s}, {"rmax", 8 * s}, {"z", 14 * s}, {"startphi", 0.3}, {"deltaphi", 4.5}});
     }},
    {"cone", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("cone", n,
               {{"rmin1", 2 * s},
                {"rmax1", 8 * s},
                {"rmin2", 1 * s},
                {"rmax2", 4 * s},
                {"z", 14 * s},
                {"startphi", 0.2},
                {"deltaphi", 5}});
     }},
    {"trd", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("trd", n,
               {{"x1", 14 * s}, {"x2", 8 * s}, {"y1", 12 * s}, {"y2", 6 * s}, {"z", 14 * s}});
     }},
    {"trap", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("trap", n,
               {{"z", 14 * s},
                {"theta", 0.2},
                {"phi", 0.4},
                {"y1", 10 * s},
                {"x1", 8 * s},
                {"x2", 11 * s},
                {"alpha1", 0.15},
                {"y2", 7 * s},
                {"x3", 5.6 * s},
                {"x4", 7.7 * s},
                {"alpha2", 0.15}});
     }},
    {"para", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("para", n,
               {{"x", 10 * s},
                {"y", 9 * s},
                {"z", 11 * s},
                {"alpha", 0.3},
                {"theta", 0.2},
                {"phi", 0.5}});
     }},
    {"orb", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("orb", n, {{"r", 9 * s}});
     }},
    {"sphere", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("sphere", n,
               {{"rmin", 4 * s},
                {"rmax", 9 * s},
                {"startphi", 0.4},
                {"deltaphi", 4},
                {"starttheta", 0.5},
                {"deltatheta", 1.8}});
     }},
    {"torus", true,
     [](Text& t, const std::string& n, double s) {
       t.solid(
           "torus", n,
           {{"rmin", 1 * s}, {"rmax", 3 * s}, {"rtor", 7 * s}, {"startphi", 0.3}, {"deltaphi", 5}});
     }},
    {"polycone", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("polycone", n, {{"startphi", 0.5}, {"deltaphi", 4.2}},
               plane(-7 * s, 2 * s, 5 * s) + plane(-2 * s, 2 * s, 8 * s) +
                   plane(3 * s, 3 * s, 6 * s) + plane(6 * s, 1 * s, 7 * s));
     }},
    {"polyhedra", true,
     [](Text& t, const std::string& n, double s) {
       t.solid(
           "polyhedra", n, {{"startphi", 0.5}, {"deltaphi", 4.2}, {"numsides", 5}},
           plane(-7 * s, 2 * s, 5 * s) + plane(-2 * s, 2 * s, 8 * s) + plane(6 * s, 1 * s, 7 * s));
     }},
    {"hype", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("hype", n,
               {{"rmin", 2 * s}, {"rmax", 5 * s}, {"inst", 0.2}, {"outst", 0.5}, {"z", 12 * s}});
     }},
    {"paraboloid", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("paraboloid", n, {{"rlo", 2 * s}, {"rhi", 8 * s}, {"dz", 7 * s}});
     }},
    {"ellipsoid", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("ellipsoid", n,
               {{"ax", 6 * s}, {"by", 8 * s}, {"cz", 10 * s}, {"zcut1", -6 * s}, {"zcut2", 9 * s}});
     }},
    {"eltube", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("eltube", n, {{"dx", 4 * s}, {"dy", 8 * s}, {"dz", 7 * s}});
     }},
    {"cutTube", true,
     [](Text& t, const std::string& n, double s) {
       t.solid("cutTube", n,
               {{"rmin", 2 * s},
                {"rmax", 7 * s},
                {"z", 12 * s},
                {"startphi", 0.3},
                {"deltaphi", 4},
                {"lowX", 0},
                {"lowY", -0.28},
                {"lowZ", -0.96},
                {"highX", 0.6},
                {"highY", 0},
                {"highZ", 0.8}});
     }},
    {"tet", false,
     [](Text& t, const std::string& n, double s) {
       const Vec3 corners[4] = {{-7 * s, -6 * s, -5 * s},
                                {8 * s, -5 * s, -4 * s},
                                {0, 9 * s, -3 * s},
                                {1 * s, 1 * s, 9 * s}};
       for (int i = 0; i < 4; ++i) t.corner(n + "_v" + std::to_string(i), corners[i]);
       t.raw_solid("<tet name=\"" + n + "_solid\" vertex1=\"" + n + "_v0\" vertex2=\"" + n +
                   "_v1\" vertex3=\"" + n + "_v2\" vertex4=\"" + n + "_v3\"/>\n");
     }},
    {"arb8", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("arb8", n,
               {{"v1x", -6 * s},
                {"v1y", -5 * s},
                {"v2x", -6 * s},
                {"v2y", 5 * s},
                {"v3x", 6 * s},
                {"v3y", 5 * s},
                {"v4x", 6 * s},
                {"v4y", -5 * s},
                {"v5x", -4 * s},
                {"v5y", -3 * s},
                {"v6x", -5 * s},
                {"v6y", 4 * s},
                {"v7x", 4 * s},
                {"v7y", 3 * s},
                {"v8x", 3 * s},
                {"v8y", -4 * s},
                {"dz", 6 * s}});
     }},
    {"genericPolycone", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("genericPolycone", n, {{"startphi", 1}, {"deltaphi", 4}},
               contour({{2, -7}, {7, -7}, {8, 0}, {6, 7}, {1, 5}, {3, 0}}, s));
     }},
    {"genericPolyhedra", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("genericPolyhedra", n, {{"startphi", 1}, {"deltaphi", 4}, {"numsides", 6}},
               contour({{2, -7}, {7, -7}, {8, 0}, {6, 7}, {1, 5}, {3, 0}}, s));
     }},
    {"xtru", false,
     [](Text& t, const std::string& n, double s) {
       std::string inner;
       const double corners[6][2] = {{-8, -6}, {8, -6}, {8, 0}, {0, 0}, {0, 8}, {-8, 8}};
       for (const auto& c : corners) {
         inner += "<twoDimVertex" + Text::list({{"x", c[0] * s}, {"y", c[1] * s}}) + "/>";
       }
       const double sections[3][3] = {{-7, 0, 1}, {1, 1, 0.7}, {7, -1, 1.1}};
       for (int i = 0; i < 3; ++i) {
         inner += "<section" +
                  Text::list({{"zOrder", i},
                              {"zPosition", sections[i][0] * s},
                              {"xOffset", sections[i][1] * s},
                              {"yOffset", 0},
                              {"scalingFactor", sections[i][2]}}) +
                  "/>";
       }
       t.solid("xtru", n, {}, inner);
     }},
    {"tessellated", false,
     [](Text& t, const std::string& n, double s) {
       const Vec3 corners[5] = {{-7 * s, -7 * s, -6 * s},
                                {7 * s, -7 * s, -6 * s},
                                {7 * s, 7 * s, -6 * s},
                                {-7 * s, 7 * s, -6 * s},
                                {1 * s, 0, 8 * s}};
       for (int i = 0; i < 5; ++i) t.corner(n + "_v" + std::to_string(i), corners[i]);
       std::string inner;
       for (int i = 0; i < 4; ++i) {
         inner += "<triangular vertex1=\"" + n + "_v" + std::to_string(i) + "\" vertex2=\"" + n +
                  "_v" + std::to_string((i + 1) % 4) + "\" vertex3=\"" + n + "_v4\"/>";
       }
       inner += "<quadrangular vertex1=\"" + n + "_v3\" vertex2=\"" + n + "_v2\" vertex3=\"" + n +
                "_v1\" vertex4=\"" + n + "_v0\"/>";
       t.solid("tessellated", n, {}, inner);
     }},
    {"elcone", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("elcone", n, {{"dx", 0.5}, {"dy", 0.4}, {"zmax", 12 * s}, {"zcut", 6 * s}});
     }},
    {"twistedbox", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("twistedbox", n, {{"PhiTwist", 0.7}, {"x", 12 * s}, {"y", 10 * s}, {"z", 14 * s}});
     }},
    {"twistedtrd", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("twistedtrd", n,
               {{"PhiTwist", 0.5},
                {"x1", 12 * s},
                {"x2", 8 * s},
                {"y1", 9 * s},
                {"y2", 11 * s},
                {"z", 13 * s}});
     }},
    {"twistedtubs", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("twistedtubs", n,
               {{"twistedangle", 0.6},
                {"endinnerrad", 3 * s},
                {"endouterrad", 8 * s},
                {"zlen", 14 * s},
                {"phi", 1.5}});
     }},
    {"union", true, [](Text& t, const std::string& n, double s) { boolean(t, "union", n, s); }},
    {"subtraction", true,
     [](Text& t, const std::string& n, double s) { boolean(t, "subtraction", n, s); }},
    {"intersection", true,
     [](Text& t, const std::string& n, double s) { boolean(t, "intersection", n, s); }},
    {"scaledSolid", false,
     [](Text& t, const std::string& n, double s) {
       t.solid("orb", n + "_ball", {{"r", 8 * s}});
       t.raw_solid("<scaledSolid name=\"" + n + "_solid\"><solidref ref=\"" + n +
                   "_ball_solid\"/><scale name=\"" + n +
                   "_by\" x=\"1.2\" y=\"-0.7\" z=\"0.9\"/></scaledSolid>\n");
     }},
};

}  // namespace

const std::vector<SampleSolid>& sample_solids() { return samples; }

}  // namespace navjit::extremes
