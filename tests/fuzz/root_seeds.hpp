// Small ROOT files, which together have most shapes, matrices and lists that the reader knows.
#pragma once

#include <filesystem>
#include <fstream>

#include "tests/support/root_geometry.hpp"

namespace navjit::fuzz {

inline void write_root_seeds(const std::filesystem::path& folder) {
  using namespace tests;
  using Numbers = std::vector<double>;
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const RootPointer& shape,
                         RootPacking packing = RootPacking::none) {
    std::ofstream(folder / (name + ".root"), std::ios::binary)
        << root_file({{"g", root_manager(root_world_around(shape))}}, packing);
  };
  const RootPointer box = root_box("box", 1, 2, 3);
  for (const auto& [name, packing] :
       std::initializer_list<std::pair<const char*, RootPacking>>{{"plain", RootPacking::none},
                                                                  {"zlib", RootPacking::zlib},
                                                                  {"lzma", RootPacking::lzma},
                                                                  {"lz4", RootPacking::lz4},
                                                                  {"zstd", RootPacking::zstd}}) {
    write(name, box, packing);
  }
  write(
      "tube",
      root_object("TGeoTubeSeg", "tube",
                  {{"fRmin", 1.0}, {"fRmax", 2.0}, {"fDz", 3.0}, {"fPhi1", 0.0}, {"fPhi2", 90.0}}));
  write("polycone", root_object("TGeoPcon", "polycone",
                                {{"fPhi1", 0.0},
                                 {"fDphi", 360.0},
                                 {"fRmin", RootCounted{"fNz", {0, 0, 0}}},
                                 {"fRmax", RootCounted{"", {1, 1, 2}}},
                                 {"fZ", RootCounted{"", {-1, 0, 1}}}}));
  write("arb8",
        root_object("TGeoArb8", "arb8",
                    {{"fDz", 3.0},
                     {"fXY", Numbers{-1, -2, -1, 2, 1, 2, 1, -2, -1, -2, -1, 2, 1, 2, 1, -2}}}));
  write("extruded", root_object("TGeoXtru", "extruded",
                                {{"fX", RootCounted{"fNvert", {-1, 1, 1, -1}}},
                                 {"fY", Numbers{-1, -1, 1, 1}},
                                 {"fNz", 2},
                                 {"fZ", Numbers{-1, 1}},
                                 {"fScale", Numbers{1, 2}},
                                 {"fX0", Numbers{0, 0}},
                                 {"fY0", Numbers{0, 0}}}));
  const RootPointer half = root_half_space({0, 0, 0}, {1, 1, 0});
  const RootPointer quarter =
      root_boolean("TGeoIntersection", half, root_half_space({0, 0, 0}, {1, 0, 0}));
  const RootPointer turned = root_placed(1, 0, 0, {0, -1, 0, 1, 0, 0, 0, 0, 1});
  write("TGeoUnion", root_boolean("TGeoUnion", box, root_box("other", 2, 1, 1), {}, turned));
  write("TGeoSubtraction", root_boolean("TGeoSubtraction", box, quarter, {}, turned));
  write("TGeoIntersection", root_boolean("TGeoIntersection", half, box, {}, turned));
  for (const bool by_members : {true, false}) {
    write(by_members ? "tessellated" : "facets",
          root_tessellated("tessellated",
                           {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {0, 2, 2}},
                           {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
                           {.by_members = by_members}));
  }
  const RootPointer row = root_volume(
      "row", root_object("TGeoShapeAssembly", "", {}),
      {root_node("a", root_volume("leaf", box), 1, {}),
       root_node("b", root_volume("leaf", box), 2, root_translation(9, 0, 0), 1U << 17)},
      {});
  std::ofstream(folder / "assembly.root", std::ios::binary)
      << root_file({{"g", root_manager(root_volume("world", root_box("hall", 50, 50, 50),
                                                   {root_node("r", row, 1, {})}))}});
}

}  // namespace navjit::fuzz
