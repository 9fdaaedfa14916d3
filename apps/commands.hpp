// The commands. Each returns the exit status; errors of the input are thrown.
#pragma once

#include <string>
#include <vector>

#include "apps/rays.hpp"
#include "apps/warmup/one_run.hpp"
#include "geometry/navigation/geometry.hpp"
#include "runtime/make_plugin.hpp"
#include "runtime/options.hpp"

namespace navjit::apps {

struct InspectOptions {
  std::string detector;
  std::string setup;  ///< of the file; empty: its default
  std::string scene;  ///< empty: all volumes in short
  bool emit = false;  ///< print the generated source of the scene
  GeometryOptions geometry;
};
int inspect(const InspectOptions& options);

struct RunOptions {
  std::string detector;
  std::string setup;
  std::uint64_t rays = 100000;
  RaySource source;
  unsigned threads = 1;
  RuntimeOptions runtime;
  std::string report;        ///< JSON file; empty: none
  std::string save_profile;  ///< file for `navjit specialise`; empty: none
};
int run(const RunOptions& options);

struct TraceOptions {
  std::string detector;
  std::string setup;
  std::string rays;  ///< a file, or a number
  std::uint64_t seed = 1;
  unsigned threads = 1;
  RuntimeOptions runtime;
  std::string out;  ///< empty: standard output
};
int trace(const TraceOptions& options);

struct AccuracyOptions {
  std::string detector;
  std::string setup;
  std::string rays = "1000";  ///< a file, or a number
  RaySource source;
  unsigned threads = 1;
  int repetitions = 5;
  std::uint64_t boundaries = 100000;  ///< of the long track
  std::size_t scenes = 12;            ///< in the table; the report has all
  GeometryOptions geometry;
  std::string report;            ///< JSON file; empty: none
  std::string picture;           ///< SVG or PNG file; empty: none
  std::string vecgeom;           ///< vecgeom_trace; empty: beside navjit; "off": without
  std::string vecgeom_detector;  ///< the detector as VecGeom can read it; empty: the same
  std::string vecgeom_navigator = "automatic";
  double vecgeom_seconds = 300;  ///< for each of its runs
};
/// Exit status 1 if one of navjit's own levels is wrong anywhere.
int accuracy(const AccuracyOptions& options);

struct WarmupOptions {
  std::string detector;
  std::string setup;
  /// Of the command line of every run: detector, rays, threads.
  std::vector<std::string> words;
  unsigned threads = 1;
  double seconds = 5;         ///< of a run
  double prime_seconds = 10;  ///< of the run that fills the cache
  double interval = 0.02;     ///< between points of the series, s
  int repetitions = 5;
  std::vector<std::string> modes{"cold", "cache", "plugin"};
  std::vector<int> optimisations{2};
  std::string report;   ///< JSON file; empty: none
  std::string csv;      ///< every point; empty: none
  std::string picture;  ///< SVG or PNG file; empty: none
};
/// Throws also if the same rays had different steps in different runs.
int warmup(const WarmupOptions& options);
/// One run of it, whose record goes to standard output.
int warmup_run(const warmup::RunSetup& setup);

struct CheckOptions {
  std::string detector;
  std::string setup;
  std::size_t resolution = 1000;  ///< points on each daughter's surface
  double tolerance = 1e-6;        ///< mm
};
/// Exit status 1 if anything overlaps.
int check(const CheckOptions& options);

enum class CacheAction : std::uint8_t { list, verify, clear, path };
struct CacheOptions {
  Cache cache;
  CacheAction action = CacheAction::list;
};
/// Exit status 1 if `verify` rejects an entry.
int cache(const CacheOptions& options);

struct SpecialiseOptions {
  std::string detector;
  std::string setup;
  std::vector<std::string> scenes;  ///< logical volumes by name
  std::string profile;              ///< file; empty: the named scenes only
  PluginChoice choice;
  bool source_only = false;
  int optimisation = 2;
  std::string out;
};
int specialise(const SpecialiseOptions& options);

struct MergeOptions {
  std::vector<std::string> profiles;
  std::string out;
};
int merge_profiles(const MergeOptions& options);

/// Makes a plugin of a shared library that was compiled from `navjit specialise --emit cpp`.
int seal_plugin(const std::string& path);

}  // namespace navjit::apps
