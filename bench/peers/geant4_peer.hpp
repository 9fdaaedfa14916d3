#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "flight.hpp"
#include "geometry/rays/ray.hpp"

namespace navjit::peers {

/// Geant4's own navigator, for measurements beside it and for comparison.
///
/// Geant4 keeps its geometry in singletons, and ends the process at a file that it cannot read: so
/// a process reads one detector, and it must be a process that may die.
class Geant4Peer {
 public:
  /// One step of a ray.
  struct Segment {
    std::string volume;  ///< the logical volume's name, as in the file
    double length;       ///< mm
  };

  /// Reads a GDML file and lets Geant4 optimise its geometry. Throws std::runtime_error if Geant4
  /// reads no world.
  explicit Geant4Peer(const std::string& gdml_file);
  Geant4Peer(const Geant4Peer&) = delete;
  Geant4Peer& operator=(const Geant4Peer&) = delete;
  ~Geant4Peer();

  /// The steps of a ray until it leaves the world; none if it starts outside. Ends early after 100
  /// steps in a row without length.
  std::vector<Segment> trace(const Ray& ray) const;

  /// The same for all rays with nothing recorded, for timing. It includes locating the starts.
  /// Returns the number of steps, zero steps included.
  std::uint64_t transport(std::span<const Ray> rays) const;

  /// Makes flights, with the safety before each step that does not start on a boundary; their sum
  /// is added to `safeties`, mm. Secondaries start from the touchable that they were born in.
  /// Returns the number of steps; the zero steps before a step count as part of it.
  std::uint64_t fly(std::span<const Flight> flights, double& safeties) const;

 private:
  struct Own;
  std::unique_ptr<Own> own_;
};

}  // namespace navjit::peers
