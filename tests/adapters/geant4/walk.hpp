// Tracks through a world of Geant4, made as Geant4's tracking makes them, with both navigators.
#pragma once

#include <G4VPhysicalVolume.hh>
#include <cstdint>

#include "navjit/geant4/session.hpp"

namespace navjit::tests {

/// What the tracks do.
struct Walk {
  std::uint64_t seed = 1;
  int tracks = 1000;
  int most_steps = 200;          ///< of a track
  double shortest_limit = 1e-3;  ///< mm; limits of steps are spread evenly over their logarithm
  double longest_limit = 1e3;    ///< mm
  double unlimited = 0.5;        ///< so many tracks are straight and stop at boundaries only
  G4ThreeVector from{-1, -1, -1}, to{1, 1, 1};  ///< where they start, in units of the world's box
  geant4::Options options{};
};

/// What came of a walk.
struct Walked {
  geant4::Counts counts{};
  std::uint64_t boundaries = 0;
  std::uint64_t without_normal = 0;  ///< boundaries that no normal was given for
  std::uint64_t stuck = 0;           ///< tracks that used up their steps though unlimited
  std::string refusal{};
};

/// Makes the tracks: steps to boundaries and to limits, scattering within the safety, additional
/// calls, secondaries that start later from their touchable. Closes the geometry.
Walked walk(G4VPhysicalVolume& world, Walk walk);

/// Makes the tracks, and expects that both navigators agree on all but 1 in 20,000 steps.
void expect_alike(G4VPhysicalVolume& world, const Walk& walk = {.tracks = 4000});

}  // namespace navjit::tests
