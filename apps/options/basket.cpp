#include "apps/options/basket.hpp"

#include <CLI/CLI.hpp>

#include "apps/options/numbers.hpp"

namespace navjit::apps {
namespace {

/// Each ray under way has a navigation stack, and a trace its rows.
constexpr std::uint64_t most = 1 << 20;

}  // namespace

void add_basket(CLI::App& command, std::size_t& basket) {
  command
      .add_option("--basket", basket, "so many rays at once in each thread (default: one by one)")
      ->transform(count(1, most))
      ->option_text("K");
}

}  // namespace navjit::apps
