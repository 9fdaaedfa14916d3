// Detectors from ROOT files that hold a TGeoManager (https://root.cern).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "navjit/detail/api.hpp"
#include "navjit/detector.hpp"
#include "navjit/errors.hpp"
#include "navjit/gdml.hpp"

namespace NAVJIT_API navjit {

/// A ROOT file that cannot be read: "FILE: CLASS 'name': problem; what to do".
struct RootError : Error {
  using Error::Error;
};

/// What a file may ask for. The defaults are far above any real detector's; they keep a hostile
/// file from exhausting memory or time.
struct RootLimits {
  std::size_t max_bytes = std::size_t{1} << 30;  ///< bytes of the geometry, unpacked
  std::size_t max_keys = 100'000;                ///< objects and folders in the file
  std::size_t max_placements = 1'000'000;        ///< daughters of all volumes and assemblies
  std::size_t max_name_bytes = 64'000'000;       ///< bytes of all their names
  std::size_t max_solid_depth = 200;             ///< levels of nested booleans; chains of unions,
                                                 ///< or of what is cut from one solid, have few
  std::size_t max_solid_chain = 1000;            ///< links of such a chain
  std::size_t max_solid_parts = 10'000;          ///< primitives that make up one boolean
  std::size_t max_facets = 4'000'000;            ///< facets of all tessellated solids, and vertices
};

/// Which part of a file is read, and within which limits.
struct RootOptions {
  /// The name of the TGeoManager, or of a single TGeoVolume. Empty: the first TGeoManager, or if
  /// there is none the first volume.
  std::string key{};
  RootLimits limits{};
};

/// Whether a file begins as ROOT files do, whatever its name. False where it cannot be opened.
/// Thread-safe.
bool is_root_file(const std::filesystem::path& path);

/// Reads the geometry of a ROOT file: the tree below the master volume of a TGeoManager, or a
/// volume. Centimetres become mm; placements have ROOT's names and node numbers; divisions are
/// written out; assemblies are dissolved into the volumes that hold them. Throws RootError, and
/// nothing else but std::bad_alloc. Thread-safe.
Detector read_root(const std::filesystem::path& path, const RootOptions& options = {},
                   GdmlReport* report = nullptr);

}  // namespace navjit
