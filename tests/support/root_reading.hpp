// A file of ROOT that a test writes and reads.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "geometry/solids/solid.hpp"
#include "navjit/root.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/root_geometry.hpp"

namespace navjit::tests {

class RootReading : public testing::Test {
 protected:
  Detector read_bytes(const std::string& bytes, const RootOptions& options = {},
                      GdmlReport* report = nullptr) {
    write_file(file_, bytes);
    return read_root(file_, options, report);
  }
  /// A geometry with this top volume.
  Detector read(const RootPointer& world, GdmlReport* report = nullptr) {
    return read_bytes(root_file({{"geometry", root_manager(world)}}), {}, report);
  }
  /// The error that reading ends in; empty if there is none.
  std::string refusal_of_bytes(const std::string& bytes, const RootOptions& options = {}) {
    try {
      read_bytes(bytes, options);
    } catch (const RootError& e) {
      return e.what();
    }
    return "";
  }
  std::string refusal(const RootPointer& world) {
    return refusal_of_bytes(root_file({{"geometry", root_manager(world)}}));
  }

  /// The solid of a shape.
  Solid solid(const RootPointer& shape) {
    const Detector detector = read(root_world_around(shape));
    return detector.volume(*detector.find_volume("inner")).solid;
  }
  /// Whether a point, mm, is inside it.
  static bool has(const Solid& solid, const Vec3& p) {
    return kernels::inside(solid.any(), p, 1e-9) == kernels::Side::inside;
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("detector.root");
};

}  // namespace navjit::tests
