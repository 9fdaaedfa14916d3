#include "tests/extremes/special_scenes.hpp"

#include <cmath>

#include "tests/extremes/scene_text.hpp"

namespace navjit::extremes {
namespace {

constexpr double turn = 2 * M_PI;

/// Solids in a row of cells along x, turned one way and another, in a box.
class Row {
 public:
  explicit Row(double pitch) : pitch_(pitch) {}

  void add(const char* tag, const Attributes& attributes) {
    const std::string name = std::string(tag) + std::to_string(count_);
    scene_.solid(tag, name, attributes);
    scene_.volume(name);
    const double angle = count_ % 2 == 0 ? 0 : 0.3 * count_;
    scene_.place("world", name, {pitch_ * (count_ + 0.5), 0, 0}, {angle, angle / 3, -angle});
    ++count_;
  }
  std::string finished() {
    scene_.solid("box", "world",
                 {{"x", 2 * pitch_ * (count_ + 0.1)}, {"y", 1.2 * pitch_}, {"z", 1.2 * pitch_}});
    scene_.volume("world");
    return scene_.finished("world");
  }

 private:
  SceneText scene_;
  double pitch_;
  int count_ = 0;
};

void add_box(SceneText& scene, const std::string& name, double x, double y, double z) {
  scene.solid("box", name, {{"x", x}, {"y", y}, {"z", z}});
}

}  // namespace

std::string thin_shells() {
  SceneText scene;
  constexpr double micrometre = 1e-3;
  for (int i = 0; i < 5; ++i) {
    const std::string number = std::to_string(i);
    const double in = 1e4 + i * micrometre, out = 1e4 + (i + 1) * micrometre;
    scene.solid("sphere", "ball" + number,
                {{"rmin", in},
                 {"rmax", out},
                 {"startphi", 0},
                 {"deltaphi", turn},
                 {"starttheta", 0},
                 {"deltatheta", M_PI}});
    scene.solid("tube", "pipe" + number,
                {{"rmin", in / 2},
                 {"rmax", in / 2 + micrometre},
                 {"z", 1e4},
                 {"startphi", 0},
                 {"deltaphi", turn}});
    add_box(scene, "plate" + number, 2e4, 2e4, micrometre);
    for (const char* kind : {"ball", "pipe", "plate"}) {
      scene.volume(kind + number);
      const bool plate = kind[1] == 'l';
      scene.place("world", kind + number, {0, 0, plate ? 1.1e4 + (i + 0.5) * micrometre : 0});
    }
  }
  add_box(scene, "world", 3e4, 3e4, 3e4);
  scene.volume("world");
  return scene.finished("world");
}

std::string odd_tori(bool self_crossing) {
  Row row(50);
  const auto add = [&](double rmin, double rmax, double rtor, double phi) {
    row.add("torus",
            {{"rmin", rmin}, {"rmax", rmax}, {"rtor", rtor}, {"startphi", 0.4}, {"deltaphi", phi}});
  };
  for (const double phi : {turn, 3.7}) {
    add(0, 7, 7 * (1 + 1e-10), phi);  // the hole nearly closed
    add(0, 7, 7 * (1 + 1e-15), phi);
    add(6.999999, 7, 12, phi);         // a thin wall
    add(7 * (1 - 1e-12), 7, 12, phi);  // thinner
    add(0, 1e-3, 20, phi);             // a wire
    add(0, 1e-8, 20, phi);             // hardly anything
    add(1e-9, 5, 12, phi);             // a bore that is hardly there
    if (!self_crossing) continue;
    add(0, 7, 7, phi);   // the hole is a point
    add(0, 10, 7, phi);  // it crosses itself
    add(3, 10, 2, phi);  // nearly a ball
  }
  return row.finished();
}

std::string odd_cones() {
  Row row(30);
  const auto add = [&](double rmin1, double rmax1, double rmin2, double rmax2, double z) {
    row.add("cone", {{"rmin1", rmin1},
                     {"rmax1", rmax1},
                     {"rmin2", rmin2},
                     {"rmax2", rmax2},
                     {"z", z},
                     {"startphi", 0},
                     {"deltaphi", turn}});
  };
  for (const double by : {1e-15, 1e-12, 1e-9, 1e-6}) {
    add(0, 8, 0, 8 * (1 + by), 14);
    add(3, 8, 3 * (1 - by), 8 * (1 - by), 14);
  }
  add(0, 8, 0, 0, 14);               // to the point
  add(0, 1e-12, 0, 8, 14);           // nearly
  add(7, 8, 8 * (1 - 1e-9), 8, 14);  // to an edge
  add(0, 0, 0, 8, 1e-6);             // as flat as can be
  add(0, 8, 0, 1e-6, 20);
  add(0, 1e-6, 0, 2e-6, 20);  // a needle
  return row.finished();
}

std::string odd_wedges() {
  Row row(30);
  for (const double delta : {turn - 1e-6, turn - 1e-8, 1e-8, 1e-3, M_PI, M_PI - 1e-12, M_PI + 1e-12,
                             M_PI / 2, M_PI / 2 + 1e-15}) {
    row.add("tube", {{"rmin", 2}, {"rmax", 8}, {"z", 14}, {"startphi", 0.7}, {"deltaphi", delta}});
    row.add("cone", {{"rmin1", 0},
                     {"rmax1", 8},
                     {"rmin2", 0},
                     {"rmax2", 4},
                     {"z", 14},
                     {"startphi", 0},
                     {"deltaphi", delta}});
    row.add("sphere", {{"rmin", 3},
                       {"rmax", 8},
                       {"startphi", 1},
                       {"deltaphi", delta},
                       {"starttheta", 0.3},
                       {"deltatheta", 2}});
  }
  for (const double theta : {1e-8, 1e-3, M_PI / 2, M_PI / 2 - 1e-12, M_PI - 1e-6}) {
    row.add("sphere", {{"rmin", 0},
                       {"rmax", 8},
                       {"startphi", 0},
                       {"deltaphi", turn},
                       {"starttheta", 0},
                       {"deltatheta", theta}});
  }
  return row.finished();
}

std::string touching_volumes() {
  SceneText scene;
  add_box(scene, "brick", 10, 10, 10);
  scene.volume("brick");
  add_box(scene, "half", 5, 10, 10);
  scene.volume("half");
  scene.solid("tube", "rod",
              {{"rmin", 0}, {"rmax", 5}, {"z", 10}, {"startphi", 0}, {"deltaphi", turn}});
  scene.volume("rod");
  scene.solid("tube", "pipe",
              {{"rmin", 5}, {"rmax", 7}, {"z", 10}, {"startphi", 0}, {"deltaphi", turn}});
  scene.volume("pipe");
  scene.solid("tube", "quarter",
              {{"rmin", 7}, {"rmax", 9}, {"z", 10}, {"startphi", 0}, {"deltaphi", M_PI / 2}});
  scene.volume("quarter");
  scene.solid("orb", "ball", {{"r", 5}});
  scene.volume("ball");
  add_box(scene, "filled", 10, 10, 10);
  scene.place("filled", "half", {-2.5, 0, 0});
  scene.place("filled", "half", {2.5, 0, 0});
  scene.volume("filled");
  add_box(scene, "inscribed", 10, 10, 10);
  scene.place("inscribed", "ball", {0, 0, 0});
  scene.volume("inscribed");
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const char* names[] = {"brick", "filled", "inscribed", "rod"};
      const Vec3 quarters{0, 0, 0.5 * M_PI * ((i + j) % 4)};
      scene.place("block", names[(i + 2 * j) % 4], {-15.0 + 10 * i, -15.0 + 10 * j, 0}, quarters);
    }
  }
  add_box(scene, "block", 40, 40, 10);
  scene.volume("block");
  // Turned as a whole, so that faces coincide only to within rounding, beside one that is not.
  scene.place("world", "block", {0, 0, -25});
  scene.place("world", "block", {0, 0, -15});
  scene.place("world", "block", {0, 0, 20}, {0.3, -0.8, 0.4});
  scene.place("world", "rod", {60, 0, 0});
  scene.place("world", "pipe", {60, 0, 0});
  for (int i = 0; i < 4; ++i) {
    scene.place("world", "quarter", {60, 0, 0}, {0, 0, 0.5 * M_PI * i});
  }
  for (int i = 0; i < 5; ++i) {
    scene.place("world", "ball", {-60.0, -20.0 + 10 * i, 0});
    scene.place("world", "ball", {-60.0 - 10 * 0.6, -20.0 + 10 * i + 10 * 0.8, 40});
  }
  add_box(scene, "world", 150, 100, 120);
  scene.volume("world");
  return scene.finished("world");
}

std::string nested_copies() {
  SceneText scene;
  constexpr int levels = 30;
  for (int i = levels; i-- > 0;) {
    const std::string number = std::to_string(i);
    scene.solid("tube", "pipe" + number,
                {{"rmin", 3}, {"rmax", 8}, {"z", 14}, {"startphi", 0.3}, {"deltaphi", 4.5}});
    add_box(scene, "box" + number, 16, 12, 10);
    for (const char* kind : {"pipe", "box"}) {
      if (i + 1 < levels) scene.place(kind + number, kind + std::to_string(i + 1), {0, 0, 0});
      scene.volume(kind + number);
    }
  }
  scene.place("world", "box0", {-20, 0, 0});
  scene.place("world", "box0", {0, 30, 0}, {0.3, 0.4, 0.5});
  scene.place("world", "pipe0", {20, 0, 0});
  scene.place("world", "pipe0", {0, -30, 0}, {0.3, 0.4, 0.5});
  add_box(scene, "world", 100, 100, 60);
  scene.volume("world");
  return scene.finished("world");
}

std::string doubled_volumes() {
  SceneText scene;
  for (const char* name : {"one", "other"}) {
    add_box(scene, name, 16, 12, 10);
    scene.volume(name);
    scene.solid("orb", std::string(name) + "_ball", {{"r", 7}});
    scene.volume(std::string(name) + "_ball");
    for (const char* kind : {"", "_ball"}) {
      scene.place("world", std::string(name) + kind, {-15, kind[0] == '_' ? 20.0 : 0.0, 0});
      scene.place("world", std::string(name) + kind, {15, kind[0] == '_' ? 20.0 : 0.0, 0},
                  {0.3, 0.4, 0.5});
    }
  }
  add_box(scene, "world", 60, 80, 40);
  scene.volume("world");
  return scene.finished("world");
}

std::string chain(int outer, int inner) {
  SceneText scene;
  const double thin = 0.25, thick = thin * inner, length = thick * outer;
  add_box(scene, "thin", 100, 100, thin);
  scene.volume("thin");
  add_box(scene, "thick", 100, 100, thick);
  for (int i = 0; i < inner; ++i) {
    scene.place("thick", "thin", {0, 0, -thick / 2 + thin * (i + 0.5)});
  }
  scene.volume("thick");
  for (int i = 0; i < outer; ++i) {
    scene.place("world", "thick", {0, 0, -length / 2 + thick * (i + 0.5)});
  }
  add_box(scene, "world", 120, 120, length + 1);
  scene.volume("world");
  return scene.finished("world");
}

std::vector<Ray> chain_rays(const World& world) {
  const double start = -world.volumes[world.top].solid.extent.max.z + 0.1;
  const double tiny = 1e-7, sine = 1e-4;
  return {{{1, 2, start}, {0, 0, 1}},
          {{0, 0, start}, {tiny, 0, std::sqrt(1 - tiny * tiny)}},
          {{40, 2, -start}, {0, sine, -std::sqrt(1 - sine * sine)}}};
}

}  // namespace navjit::extremes
