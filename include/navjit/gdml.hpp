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

/// What a file may ask for; all its entities and modules are counted together. The defaults are far
/// above those of any real detector; they keep a hostile file from exhausting memory or time.
struct GdmlLimits {
  std::size_t max_bytes = 512u << 20;           ///< XML text read
  std::size_t max_elements = 8'000'000;         ///< XML elements
  std::size_t max_depth = 1000;                 ///< levels of nested XML elements
  std::size_t max_entities = 100'000;           ///< entity declarations in one document
  std::size_t max_name_length = 65'536;         ///< characters in a name; 512 for each
                                                ///< iteration of loops on average
  std::size_t max_loop_iterations = 1'000'000;  ///< elements processed by loops, and iterations
  std::size_t max_placements = 1'000'000;       ///< daughters of all volumes and assemblies; 64
                                                ///< characters of name for each
  int max_planes = 1000;                        ///< z planes, or sides, of one solid
  std::size_t max_solid_depth = 200;            ///< levels of nested booleans; chains of unions, or
                                                ///< of what is cut from one solid, have few
  std::size_t max_solid_chain = 1000;           ///< links of such a chain
  std::size_t max_solid_parts = 10'000;         ///< primitives that make up one boolean
  TouchableId max_touchables = TouchableId{1} << 62;
};

/// Which part of a file is read, and within which limits.
struct GdmlOptions {
  /// Name of the `<setup>` to read; empty: the one named "Default", or else the file's first.
  std::string setup{};
  GdmlLimits limits{};
};

/// What the reader has to say about a file.
struct GdmlReport {
  /// Odd things that were read nevertheless, or left out because nothing needs them: of each kind
  /// "FILE:LINE: <element name='...'>: what was done" for the first three, and then "and N more:
  /// ...".
  std::vector<std::string> notes{};
  /// Things that mean nothing for a geometry, or are read as Geant4 reads them: a line for each
  /// kind, with a count.
  std::vector<std::string> skipped{};
};

/// Reads a detector from a GDML file. Volumes keep the file's names and its order; assemblies are
/// dissolved into the volumes that hold them. Nothing is fetched from a network. Entities are
/// opened relative to the file that declares them, modules (`<file>`) relative to the working
/// folder, to the folder of that file or of the main file, or to one above. Throws GdmlError, and
/// nothing else except std::bad_alloc. Thread-safe.
Detector read_gdml(const std::filesystem::path& path, const GdmlOptions& options = {},
                   GdmlReport* report = nullptr);

/// The detector as one GDML file: materials with elements and fractions, solids, volumes with
/// tags, placements with names and copy numbers. Loops, assemblies, divisions and modules are
/// written out. Read again it is the same detector, up to the rounding of angles and of corners
/// that are computed from faces. Volumes, solids, elements or materials that share a name get
/// names of their own. Throws GeometryError if a solid cannot be expressed in GDML.
/// Thread-safe.
std::string gdml_text(const Detector& detector);

}  // namespace navjit
