// Small GDML files for the tests of the reader.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/gdml/read_world.hpp"

#define EXPECT_HAS(text, part) EXPECT_PRED_FORMAT2(::testing::IsSubstring, part, text)
#define EXPECT_LACKS(text, part) EXPECT_PRED_FORMAT2(::testing::IsNotSubstring, part, text)

namespace navjit::testing {

/// Each test has a folder of its own, which is removed afterwards.
class GdmlFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(info->test_suite_name()) + '.' + info->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    folder_ = std::filesystem::path(::testing::TempDir()) / ("navjit-" + name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  World read(const std::string& text, GdmlReport* report = nullptr) const {
    return read_world(write("det.gdml", text), {}, report);
  }
  /// The message that reading fails with; the whole test fails if it does not.
  static std::string error(const std::filesystem::path& path, const GdmlOptions& options = {}) {
    try {
      read_world(path, options);
    } catch (const GdmlError& e) {
      return e.what();
    }
    ADD_FAILURE() << path << " was read without an error";
    return {};
  }
  std::string error_of(const std::string& text, const GdmlOptions& options = {}) const {
    return error(write("det.gdml", text), options);
  }

  std::filesystem::path folder_;
};

/// The sections of a file. Defaults: world W, a box 'b' of 20 x 20 x 20 mm; volume D is that box.
struct Gdml {
  std::string define{}, solids{}, structure{};
  std::string world = "W", doctype{};

  /// Line 3 holds the definitions, 5 the solids, 6 the structure.
  operator std::string() const {
    return "<?xml version=\"1.0\"?>" + doctype + "\n<gdml>\n<define>" + define +
           "</define>\n<materials/>\n" + "<solids><box name='b' x='20' y='20' z='20'/>" + solids +
           "</solids>\n" +
           "<structure><volume name='D'><materialref ref='G4_Pb'/><solidref ref='b'/></volume>" +
           structure + "</structure>\n<setup name='Default' version='1.0'><world ref='" + world +
           "'/></setup>\n</gdml>\n";
  }
};

/// A volume whose solid is the box 'b'.
inline std::string volume(const std::string& name, const std::string& daughters = "") {
  return "<volume name='" + name + "'><materialref ref='G4_AIR'/><solidref ref='b'/>" + daughters +
         "</volume>";
}
inline std::string physvol(const std::string& ref, const std::string& rest = "",
                           const std::string& name = "") {
  return "<physvol" + (name.empty() ? "" : " name='" + name + "'") + "><volumeref ref='" + ref +
         "'/>" + rest + "</physvol>";
}

inline const LogicalVolume& top(const World& world) { return world.volumes[world.top]; }

}  // namespace navjit::testing
