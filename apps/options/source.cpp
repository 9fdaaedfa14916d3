#include "apps/options/source.hpp"

#include <CLI/CLI.hpp>

#include "apps/options/numbers.hpp"

namespace navjit::apps {

void add_seed(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "of the random rays")
      ->transform(count(0, ~std::uint64_t{0}))
      ->option_text("N");
}

void add_source(CLI::App& command, common::RaySource& source) {
  add_seed(command, source.seed);
  command
      .add_option_function<std::string>(
          "--origin",
          [&source](const std::string& text) {
            const auto v = numbers("--origin", text, 3);
            source.origin = Vec3{v[0], v[1], v[2]};
          },
          "start of all rays, mm (default: over the world)")
      ->option_text("X,Y,Z");
  command
      .add_option_function<std::string>(
          "--eta",
          [&source](const std::string& text) {
            const auto v = numbers("--eta", text, 2);
            source.eta = {v[0], v[1]};
          },
          "pseudorapidity about +z (default: isotropic)")
      ->option_text("LO,HI");
}

}  // namespace navjit::apps
