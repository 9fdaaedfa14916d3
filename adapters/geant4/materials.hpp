// Geant4's materials as navjit's.
#pragma once

#include <G4Material.hh>
#include <unordered_map>

#include "navjit/builder.hpp"

namespace navjit::geant4 {

/// Adds materials to a builder, each of them once.
class Materials {
 public:
  explicit Materials(DetectorBuilder& builder) : builder_(builder) {}
  /// Null gives a material of density 0.
  DetectorBuilder::MaterialId operator()(const G4Material* material);

 private:
  DetectorBuilder& builder_;
  std::unordered_map<const G4Element*, DetectorBuilder::ElementId> elements_{};
  std::unordered_map<const G4Material*, DetectorBuilder::MaterialId> materials_{};
};

}  // namespace navjit::geant4
