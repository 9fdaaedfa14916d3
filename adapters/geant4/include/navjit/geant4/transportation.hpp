// Touchables that are made once for each place, instead of at each boundary. Needs Geant4's run
// library and its processes/transportation.
#pragma once

#include <G4Transportation.hh>
#include <cstdint>
#include <vector>

#include "navjit/state.hpp"

namespace navjit::geant4 {

class Navigator;

/// Whether touchables are made at each boundary, as by Geant4 alone.
enum class Touchables : std::uint8_t { made, kept };

/// G4Transportation, but where navjit navigates: a track that comes back to a place gets the
/// touchable that was made when one was there before. Steps and all else are the same. A touchable
/// that somebody moved up its history is made anew. For one thread, as every process.
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
  /// That of where the track is.
  const G4TouchableHandle& touchable_of(Navigator& navigator);

  std::vector<Kept> table_{};
  std::uint64_t generation_ = 0;        ///< of the geometry that the table is of
  const G4Navigator* known_ = nullptr;  ///< the navigator that was looked at last,
  Navigator* ours_ = nullptr;           ///< as navjit's; null: it is not
  std::uint64_t kept_ = 0, made_ = 0;
};

/// Each particle's G4Transportation becomes a Transportation of the calling thread, with its
/// thresholds, which stays as long as Geant4's processes do. To be called once processes are there:
/// after G4RunManager::Initialize(), and by worker threads in WorkerRunStart(). Other processes
/// that transport (of parallel worlds, with multiple scattering) are left as they are. Null if
/// there was none to be replaced.
Transportation* keep_touchables();

}  // namespace navjit::geant4
