// The --boxes option: which box structure finds the daughters of which volume.
#pragma once

#include <string>

#include "geometry/navigation/geometry.hpp"

namespace CLI {
class App;
}

namespace navjit::apps {

/// Entries with commas between them, later ones override earlier ones: a structure for all scenes
/// that have boxes ("two-level:k-means"; see bvh::parse_structure), or VOLUME=STRUCTURE for one
/// volume ("*" for all). "auto" leaves the choice to the library. Throws UsageError
/// that says which entry is wrong.
void parse_boxes(const std::string& text, GeometryOptions& options);

void add_boxes(CLI::App& command, GeometryOptions& options);

}  // namespace navjit::apps
