// --basket: many rays at once.
#pragma once

#include <cstddef>

namespace CLI {
class App;
}

namespace navjit::apps {

/// 0 stays where it is not given.
void add_basket(CLI::App& command, std::size_t& basket);

}  // namespace navjit::apps
