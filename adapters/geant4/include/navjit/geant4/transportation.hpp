// Makes touchables once for each place, instead of at each boundary. It needs Geant4's run library
// and its processes/transportation.
#pragma once

#include <G4Transportation.hh>
#include <cstdint>
#include <vector>

#include "navjit/state.hpp"

namespace navjit::geant4 {

class Navigator;

/// Whether touchables are made at each boundary, as Geant4 alone does, or kept.
enum class Touchables : std::uint8_t { made, kept };

/// Is G4Transportation, but where navjit navigates a track that comes back to a place gets the
/// touchable that was made for it before. Steps and everything else are the same. A touchable that
/// user code moved up its history is made anew. For one thread, as every process.
class Transportation : public G4Transportation {
 public:
  explicit Transportation(G4int verbosity = 0);

  G4VParticleChange* PostStepDoIt(const G4Track& track, const G4Step& step) override;

  /// How many boundaries were crossed with a touchable that was kept, and with one that was made.
  std::uint64_t kept() const { return kept_; }
  std::uint64_t made() const { return made_; }

 private:
  struct Kept {
    TouchableId at = 0;
    G4TouchableHandle touchable{};
  };

  /// The thread's navigator, if it is navjit's and navjit answers; else null.
  Navigator* navjit();
  /// The touchable of where the track is.
  const G4TouchableHandle& touchable_of(Navigator& navigator);

  std::vector<Kept> table_{};
  std::uint64_t generation_ = 0;        ///< that of the geometry which the table is for
  const G4Navigator* known_ = nullptr;  ///< the navigator that was looked at last
  Navigator* ours_ = nullptr;           ///< the same as navjit's; null: it is not navjit's
  std::uint64_t kept_ = 0, made_ = 0;
};

/// Replaces each particle's G4Transportation by a Transportation of the calling thread, with the
/// same thresholds, which lives as long as Geant4's processes do. Call it once processes exist:
/// after G4RunManager::Initialize(), and in worker threads in WorkerRunStart(). Other processes
/// that transport (of parallel worlds, with multiple scattering) are left as they are. Null if
/// there was none to be replaced.
Transportation* keep_touchables();

}  // namespace navjit::geant4
