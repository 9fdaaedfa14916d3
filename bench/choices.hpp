// What the benchmarks let their users choose from.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/choices.hpp"
#ifdef NAVJIT_VECGEOM
#include "bench/peers/vecgeom_peer.hpp"
#endif

namespace navjit::bench {

inline void add_isa_option(CLI::App& app, std::vector<InstructionSet>& sets) {
  app.add_option("--isa", sets,
                 "instructions of generated code, one navigator each: native, sse4.2, avx2, avx512")
      ->transform(CLI::CheckedTransformer(common::instruction_sets).description(""))
      ->delimiter(',');
}

/// "navjit specialised", with the instruction set where there are several.
inline std::string specialised_name(InstructionSet set, const std::vector<InstructionSet>& sets) {
  std::string name = "navjit specialised";
  for (const auto& [text, value] : common::instruction_sets) {
    if (value == set && sets.size() > 1) name += ", " + text;
  }
  return name;
}

#ifdef NAVJIT_VECGEOM
inline const common::Choices<peers::VecGeomNavigator> vecgeom_navigators{
    {"VecGeom simple", peers::VecGeomNavigator::simple},
    {"VecGeom ABBox", peers::VecGeomNavigator::abbox},
    {"VecGeom Hybrid", peers::VecGeomNavigator::hybrid},
    {"VecGeom BVH", peers::VecGeomNavigator::bvh},
    {"VecGeom auto", peers::VecGeomNavigator::automatic}};
#endif

}  // namespace navjit::bench
