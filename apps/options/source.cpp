#include "apps/options/source.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

#include "apps/options/numbers.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {

void add_source(CLI::App& command, common::RaySource& source) {
  command.add_option("--seed", source.seed, "of the random rays (default: 1)")
      ->transform(count(0, ~std::uint64_t{0}))
      ->option_text("N");
  CLI::Option* origin = command
                            .add_option_function<std::string>(
                                "--origin",
                                [&source](const std::string& text) {
                                  const auto v = numbers("--origin", text, 3);
                                  source.origin = Vec3{v[0], v[1], v[2]};
                                },
                                "start of all rays, mm (default: over the world)")
                            ->option_text("X,Y,Z");
  CLI::Option* eta = command
                         .add_option_function<std::string>(
                             "--eta",
                             [&source](const std::string& text) {
                               const auto v = numbers("--eta", text, 2);
                               if (!(v[0] <= v[1]) || v[0] < -largest_eta || v[1] > largest_eta) {
                                 throw CLI::ValidationError(
                                     "--eta", "'" + text +
                                                  "' is not a range from low to high, within 15 "
                                                  "of 0");
                               }
                               source.eta = {v[0], v[1]};
                             },
                             "pseudorapidity about +z (default: isotropic)")
                         ->option_text("LO,HI");
  command
      .add_option("--aim", source.aim,
                  "isotropic rays through random points of the boxes of a\nvolume; auto: of the "
                  "box with most touchables")
      ->check(not_empty())
      ->option_text("VOLUME|auto")
      ->excludes(origin)
      ->excludes(eta);
}

std::string text_of(const RayOptions& options) {
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return std::string(text);
  };
  if (!options.file().empty()) return options.file();
  const common::RaySource& source = options.source;
  std::string text = number(std::strtod(options.rays.c_str(), nullptr)) + " rays of seed " +
                     std::to_string(source.seed);
  if (source.origin) {
    text += " from " + number(source.origin->x) + ',' + number(source.origin->y) + ',' +
            number(source.origin->z);
  }
  if (source.eta) text += " eta " + number(source.eta->first) + ',' + number(source.eta->second);
  if (!source.aim.empty()) text += " at " + source.aim;
  return text;
}

void add_part(CLI::App& command, std::optional<common::Part>& part) {
  command
      .add_option_function<std::string>(
          "--part",
          [&part](const std::string& text) {
            try {
              part = common::parse_part(text);
            } catch (const UsageError& error) {
              throw CLI::ValidationError("--part", error.what());
            }
          },
          "of all rays only the K-th of N stretches, for many machines")
      ->option_text("K/N");
}

void add_rays(CLI::App& command, RayOptions& options) {
  const std::string otherwise = options.rays.empty() ? "" : " (default: " + options.rays + ")";
  command.add_option("--rays", options.rays, "CSV file of rays, or their number" + otherwise)
      ->check(rays_or_count())
      ->option_text("FILE|N");
  add_source(command, options.source);
  command.parse_complete_callback([&command, &options] {
    if (options.file().empty()) return;
    for (const char* name : {"--seed", "--origin", "--eta", "--aim"}) {
      if (command.get_option(name)->count() == 0) continue;
      throw CLI::ValidationError(name, "the rays of a file have their own starts and directions");
    }
  });
}

}  // namespace navjit::apps
