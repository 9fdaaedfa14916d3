// VecGeom's world in a test: one for each process, since VecGeom's manager is a singleton. CTest
// runs each test in a process of its own; if you run it by hand, name one test.
#pragma once

#include <VecGeom/gdml/Frontend.h>
#include <VecGeom/management/ABBoxManager.h>
#include <VecGeom/management/GeoManager.h>
#include <VecGeom/navigation/NavStatePool.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include "navjit/vecgeom.hpp"

namespace navjit::tests {

/// Takes what is written to std::cout and std::cerr while it lives: VecGeom prints much.
class Quiet {
 public:
  Quiet() : cout_(std::cout.rdbuf(text_.rdbuf())), cerr_(std::cerr.rdbuf(text_.rdbuf())) {}
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
  ~Quiet() {
    std::cout.rdbuf(cout_);
    std::cerr.rdbuf(cerr_);
  }

 private:
  std::ostringstream text_;
  std::streambuf* cout_;
  std::streambuf* cerr_;
};

inline bool& has_world() {
  static bool has = false;
  return has;
}

/// Reads a file. `unit` is the length of a mm in VecGeom's unit.
inline void load_world(const std::string& file, double unit = 1) {
  ASSERT_FALSE(std::exchange(has_world(), true)) << "one world a process: run one test of these";
  const Quiet quiet;
  ASSERT_TRUE(vgdml::Frontend::Load(file, false, unit, false)) << file;
}

/// The file of a published detector in `data`, or else of one of the project.
inline std::string detector_file(const std::string& name) {
  const std::filesystem::path own = std::filesystem::path(NAVJIT_DETECTORS_DIR) / name;
  if (std::filesystem::exists(own)) return own;
  const char* folder = std::getenv("NAVJIT_DATA");
  return std::filesystem::path(folder ? folder : NAVJIT_DATA_DIR) / name;
}

/// A state with room for the deepest path of the world, and for what was left last.
struct OwnedState {
  OwnedState()
      : state(::vecgeom::NavigationState::MakeInstance(
            ::vecgeom::GeoManager::Instance().getMaxDepth())) {}
  OwnedState(const OwnedState&) = delete;
  OwnedState& operator=(const OwnedState&) = delete;
  ~OwnedState() { ::vecgeom::NavigationState::ReleaseInstance(state); }
  ::vecgeom::NavigationState& operator*() const { return *state; }
  ::vecgeom::NavigationState* operator->() const { return state; }

  ::vecgeom::NavigationState* state;
};

}  // namespace navjit::tests
