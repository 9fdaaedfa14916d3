// Which random rays a command shoots.
#pragma once

#include "common/rays.hpp"

namespace CLI {
class App;
}

namespace navjit::apps {

/// --seed alone: rays over the whole world, in all directions.
void add_seed(CLI::App& command, std::uint64_t& seed);

/// --seed, --origin, --eta.
void add_source(CLI::App& command, common::RaySource& source);

}  // namespace navjit::apps
