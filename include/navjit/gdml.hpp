// Detectors from GDML files (https://gdml.web.cern.ch), with the conventions of Geant4's reader.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/detector.hpp"
#include "navjit/errors.hpp"

namespace NAVJIT_API navjit {

/// What a file may ask for, all its entities and modules counted together. The defaults are far
/// above any real detector's; they keep a hostile file from exhausting memory or time.
struct GdmlLimits {
  std::size_t max_bytes = 512u << 20;           ///< XML text read
  std::size_t max_elements = 8'000'000;         ///< XML elements
  std::size_t max_depth = 1000;                 ///< levels of nested XML elements
  std::size_t max_entities = 100'000;           ///< entity declarations in one document
  std::size_t max_name_length = 65'536;         ///< characters in a name; 512 for each
                                                ///< iteration of loops on average
  std::size_t max_loop_iterations = 1'000'000;  ///< elements processed by loops, and their turns
  std::size_t max_placements = 1'000'000;       ///< daughters of all volumes and assemblies; 64
                                                ///< characters of name for each
  int max_planes = 1000;                        ///< z planes, or sides, of one solid
  std::size_t max_solid_depth = 200;            ///< levels of nested booleans; chains of unions,
                                                ///< or of what is cut from one solid, have few
  std::size_t max_solid_chain = 1000;           ///< links of such a chain
  std::size_t max_solid_parts = 10'000;         ///< primitives that make up one boolean
  TouchableId max_touchables = TouchableId{1} << 62;
};

/// What is read of a file.
struct GdmlOptions {
  /// Name of the `<setup>` to read; empty: the one named "Default", or else the file's first.
  std::string setup{};
  GdmlLimits limits{};
};

/// What the reader has to say of a file.
struct GdmlReport {
  /// What is odd in the file and was read nevertheless, or left out because nothing needs it:
  /// "FILE:LINE: <element name='...'>: what was done". Of each kind the first three, then
  /// "and N more: ...".
  std::vector<std::string> notes{};
  /// What means nothing for a geometry or is read as Geant4 does: a line for each kind, with a
  /// count.
  std::vector<std::string> skipped{};
};

/// Reads a detector from a GDML file. Volumes keep the file's names and its
/// order; assemblies are dissolved into the volumes that hold them. Nothing is fetched from a
/// network; entities are opened relative to the file that declares them, modules (`<file>`) to the
/// working folder, that file's, the main file's or one above. Throws GdmlError, and nothing else
/// but std::bad_alloc. Thread-safe.
Detector read_gdml(const std::filesystem::path& path, const GdmlOptions& options = {},
                   GdmlReport* report = nullptr);

/// The detector as a GDML file of its own: materials with elements and fractions, solids, volumes
/// with tags, placements with names and copy numbers; without loops, assemblies, divisions and
/// modules, which are written out. Read again it is the same detector, up to the rounding of angles
/// and of corners that are found again from faces. Two volumes, solids, elements or materials of
/// one name get names of their own. Throws GeometryError if a solid cannot be said in GDML.
/// Thread-safe.
std::string gdml_text(const Detector& detector);

}  // namespace navjit
