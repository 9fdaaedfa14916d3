// The reader of GDML files (navjit/gdml.hpp) for callers that need the world itself.
#pragma once

#include "geometry/model/world.hpp"
#include "navjit/gdml.hpp"

namespace navjit {

/// As read_gdml(); the world that it returns is finished.
World read_world(const std::filesystem::path& path, const GdmlOptions& options = {},
                 GdmlReport* report = nullptr);

}  // namespace navjit
