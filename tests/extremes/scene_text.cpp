#include "tests/extremes/scene_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace navjit::extremes {

std::string SceneText::list(const Attributes& attributes) {
  std::string out;
  for (const auto& [key, value] : attributes) {
    char number[40];
    std::snprintf(number, sizeof number, "%.17g", value);
    out += std::string(" ") + key + "=\"" + number + "\"";
  }
  return out;
}

std::string SceneText::vector(const char* tag, const std::string& name, const Vec3& v,
                              const char* unit) {
  return std::string("<") + tag + " name=\"" + name + "\"" +
         list({{"x", v.x}, {"y", v.y}, {"z", v.z}}) + " unit=\"" + unit + "\"/>";
}

void SceneText::solid(const char* tag, const std::string& name, const Attributes& attributes,
                      const std::string& inner) {
  solids_ += std::string("<") + tag + " name=\"" + name + "_solid\"" + list(attributes) +
             " lunit=\"mm\" aunit=\"rad\">" + inner + "</" + tag + ">\n";
}

void SceneText::corner(const std::string& name, const Vec3& p) {
  define_ += vector("position", name, p, "mm") + "\n";
}

void SceneText::volume(const std::string& name) {
  structure_ += "<volume name=\"" + name + "\"><materialref ref=\"Vacuum\"/><solidref ref=\"" +
                name + "_solid\"/>";
  for (const auto& [mother, text] : placements_) {
    if (mother == name) structure_ += text;
  }
  structure_ += "</volume>\n";
}

void SceneText::place(const std::string& mother, const std::string& daughter, const Vec3& at,
                      const Vec3& angles) {
  const std::string name = daughter + "_" + std::to_string(placed_++);
  std::string text = "\n<physvol name=\"" + name + "\"><volumeref ref=\"" + daughter + "\"/>" +
                     vector("position", name + "_at", at, "mm");
  if (angles.x != 0 || angles.y != 0 || angles.z != 0) {
    text += vector("rotation", name + "_turn", angles, "rad");
  }
  placements_.emplace_back(mother, text + "</physvol>");
}

std::string SceneText::finished(const std::string& world) const {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gdml>\n<define>\n" + define_ +
         "</define>\n<materials>\n<material name=\"Vacuum\" Z=\"1\"><D value=\"1e-25\" "
         "unit=\"g/cm3\"/><atom value=\"1.008\"/></material>\n</materials>\n<solids>\n" +
         solids_ + "</solids>\n<structure>\n" + structure_ +
         "</structure>\n<setup name=\"Default\" version=\"1.0\"><world ref=\"" + world +
         "\"/></setup>\n</gdml>\n";
}

std::string every_solid(double scale, bool for_vecgeom, const Vec3& centre) {
  SceneText scene;
  std::vector<std::string> names;
  for (const SampleSolid& sample : sample_solids()) {
    if (for_vecgeom && !sample.for_vecgeom) continue;
    const std::string name = sample.kind;
    sample.write(scene, name, scale);
    scene.volume(name);
    names.push_back(name);
  }
  constexpr int side = 4;
  const double pitch = 34 * scale;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto cell = [&](std::size_t k) { return pitch * (static_cast<double>(k) - 1.5); };
    const Vec3 at{centre.x + cell(i % side), centre.y + cell(i / side % side),
                  centre.z + cell(i / side / side)};
    const double turn = i % 2 == 0 ? 0 : 0.1 * static_cast<double>(i + 1);
    scene.place("world", names[i], at, {turn, -turn / 2, 1.7 * turn});
  }
  const double half = 4 * side * pitch / 8;
  const auto full = [&](double c) { return 2 * (half + std::abs(c)); };
  scene.solid("box", "world",
              {{"x", full(centre.x)}, {"y", full(centre.y)}, {"z", full(centre.z)}});
  scene.volume("world");
  return scene.finished("world");
}

}  // namespace navjit::extremes
