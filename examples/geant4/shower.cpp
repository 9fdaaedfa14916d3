// A complete application: showers in a calorimeter, navigated by navjit or by Geant4, or by both.
#include <navjit/geant4/transportation.hpp>
#include <navjit/geant4/use.hpp>
#include <navjit/geant4/worker.hpp>

#include <G4MTRunManager.hh>
#include <G4RunManager.hh>
#include <Randomize.hh>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "actions.hpp"
#include "detector.hpp"
#include "physics.hpp"

namespace {

constexpr const char* usage =
    "usage: shower [DETECTOR.gdml] [--navigator navjit|geant4|shadow] [--events N] [--threads T]\n"
    "              [--particle NAME] [--energy GEV] [--from X,Y,Z] [--along X,Y,Z] [--spread MM]\n"
    "              [--cone RAD] [--field TESLA] [--cut MM] [--seed N] [--out EVENTS.csv]\n"
    "              [--touchables kept|made] [--runs N]\n";

struct Arguments {
  std::string file{}, navigator = "navjit", out{};
  int events = 10, threads = 1, runs = 1;
  long seed = 1;
  double field = 0, cut = 0.7;
  navjit::geant4::Touchables touchables = navjit::geant4::Touchables::made;
  Gun gun{};
};

void read_vector(const std::string& text, double (&v)[3]) {
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf", &v[0], &v[1], &v[2]) != 3) {
    throw std::invalid_argument("'" + text + "' is no X,Y,Z");
  }
}

navjit::geant4::Touchables touchables_of(const std::string& word) {
  if (word == "kept") return navjit::geant4::Touchables::kept;
  if (word == "made") return navjit::geant4::Touchables::made;
  throw std::invalid_argument("touchables are kept or made, not '" + word + "'");
}

Arguments read(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key.substr(0, 2) != "--") {
      a.file = key;
      continue;
    }
    if (++i == argc) throw std::invalid_argument(key + " needs a value");
    const std::string value = argv[i];
    if (key == "--navigator")
      a.navigator = value;
    else if (key == "--events")
      a.events = std::stoi(value);
    else if (key == "--threads")
      a.threads = std::stoi(value);
    else if (key == "--particle")
      a.gun.particle = value;
    else if (key == "--energy")
      a.gun.energy = std::stod(value);
    else if (key == "--from")
      read_vector(value, a.gun.from);
    else if (key == "--along")
      read_vector(value, a.gun.along);
    else if (key == "--spread")
      a.gun.spread = std::stod(value);
    else if (key == "--cone")
      a.gun.cone = std::stod(value);
    else if (key == "--field")
      a.field = std::stod(value);
    else if (key == "--cut")
      a.cut = std::stod(value);
    else if (key == "--seed")
      a.seed = std::stol(value);
    else if (key == "--out")
      a.out = value;
    else if (key == "--runs")
      a.runs = std::stoi(value);
    else if (key == "--touchables")
      a.touchables = touchables_of(value);
    else
      throw std::invalid_argument("there is no option " + key);
  }
  return a;
}

navjit::geant4::Mode mode_of(const std::string& name) {
  if (name == "navjit") return navjit::geant4::Mode::navjit;
  if (name == "geant4") return navjit::geant4::Mode::geant4;
  if (name == "shadow") return navjit::geant4::Mode::shadow;
  throw std::invalid_argument("there is no navigator '" + name + "'");
}

void print(Sums& sums, const std::string& file) {
  std::sort(sums.events.begin(), sums.events.end(),
            [](const EventSums& a, const EventSums& b) { return a.event < b.event; });
  EventSums all{};
  for (const EventSums& event : sums.events) {
    all.deposited += event.deposited;
    all.leaked += event.leaked;
    all.steps += event.steps;
    all.seconds += event.seconds;
  }
  const auto events = static_cast<double>(std::max<std::size_t>(sums.events.size(), 1));
  std::printf("%zu events: %.6g MeV deposited, %.6g MeV leaked, %.6g steps, %.4g s each\n",
              sums.events.size(), all.deposited / events, all.leaked / events,
              static_cast<double>(all.steps) / events, all.seconds / events);
  if (file.empty()) return;
  std::ofstream out(file);
  out.precision(17);
  out << "event,deposited,leaked,steps,seconds\n";
  for (const EventSums& e : sums.events) {
    out << e.event << ',' << e.deposited << ',' << e.leaked << ',' << e.steps << ',' << e.seconds
        << '\n';
  }
}

void run(const Arguments& arguments) {
  name_empty_data();
  // The one line: before the run manager is made.
  const auto session = navjit::geant4::use({.mode = mode_of(arguments.navigator)});

  std::unique_ptr<G4RunManager> manager;
  if (arguments.threads > 1) {
    auto* shared = new G4MTRunManager;
    manager.reset(shared);
    shared->SetNumberOfThreads(arguments.threads);
    // And one for the threads.
    shared->SetUserInitialization(
        new navjit::geant4::WorkerInitialization(session, arguments.touchables));
  } else {
    manager = std::make_unique<G4RunManager>();
  }
  Sums sums;
  G4Random::setTheSeed(arguments.seed);
  manager->SetUserInitialization(new Detector(arguments.file, arguments.field));
  manager->SetUserInitialization(new Physics(arguments.cut));
  manager->SetUserInitialization(new Actions(arguments.gun, sums));
  manager->Initialize();
  const navjit::geant4::Transportation* transportation =
      arguments.touchables == navjit::geant4::Touchables::kept ? navjit::geant4::keep_touchables()
                                                               : nullptr;
  for (int run = 0; run < arguments.runs; ++run) {
    // As where the detector was changed since the last run.
    if (run > 0) session->geometry_changed();
    manager->BeamOn(arguments.events);
  }
  print(sums, arguments.out);
  if (transportation != nullptr && arguments.threads == 1) {
    std::printf("touchables: %llu kept, %llu made\n",
                static_cast<unsigned long long>(transportation->kept()),
                static_cast<unsigned long long>(transportation->made()));
  }
  navjit::geant4::print_report(*session, std::cout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(read(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "shower: %s\n%s", error.what(), usage);
    return 2;
  }
}
