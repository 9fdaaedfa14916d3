// What is shot, and what is summed up.
#pragma once

#include <G4VUserActionInitialization.hh>
#include <mutex>
#include <string>
#include <vector>

/// Of one event. Energies in MeV.
struct EventSums {
  int event;
  double deposited = 0;
  double leaked = 0;  ///< kinetic energy that left the world
  long steps = 0;
  double seconds = 0;  ///< processor time of its thread
};

/// Of all threads.
struct Sums {
  std::mutex mutex{};
  std::vector<EventSums> events{};
};

/// What is shot.
struct Gun {
  std::string particle = "e-";
  double energy = 10;  ///< GeV
  double from[3] = {0, 0, 0}, along[3] = {0, 0, 1};
  double spread = 0;  ///< mm: the origin is anywhere in a square of that half width
  double cone = 0;    ///< rad: the direction is anywhere in a cone of that half angle
};

/// Primaries and sums for each thread.
class Actions : public G4VUserActionInitialization {
 public:
  Actions(const Gun& gun, Sums& sums) : gun_(gun), sums_(sums) {}
  void Build() const override;

 private:
  const Gun& gun_;
  Sums& sums_;
};
