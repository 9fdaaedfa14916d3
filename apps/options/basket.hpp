// --basket: many rays at once.
#pragma once

#include <cstddef>

namespace CLI {
class App;
}

namespace navjit::apps {

/// Leaves `basket` as it is where the option is not given.
void add_basket(CLI::App& command, std::size_t& basket);

}  // namespace navjit::apps
