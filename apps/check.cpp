// `navjit check`: overlaps and protrusions.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "common/text.hpp"
#include "geometry/check/overlaps.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  OverlapOptions overlaps;
};

int check(const Options& options) {
  const Geometry geometry(read(options.detector));
  const OverlapReport report = check_overlaps(geometry, options.overlaps);
  const std::vector<Overlap>& overlaps = report.overlaps;
  const World& world = geometry.world();
  const auto name = [&](VolumeId mother, std::uint32_t k) {
    const Placement& p = world.volumes[mother].daughters[k];
    return common::printable(p.name.empty() ? world.volumes[p.volume].name : p.name) + " (number " +
           std::to_string(k) + ")";
  };
  for (const auto& [mother, k] : report.not_sampled) {
    std::printf("%s: %s is not checked: no point on its surface was found\n",
                common::printable(world.volumes[mother].name).c_str(), name(mother, k).c_str());
  }
  for (const Overlap& o : overlaps) {
    const LogicalVolume& mother = world.volumes[o.volume];
    const bool sticks_out = o.second == Overlap::mother;
    std::printf("%s: %s %s%s by at least %.6g mm at %.9g,%.9g,%.9g\n",
                common::printable(mother.name).c_str(), name(o.volume, o.first).c_str(),
                sticks_out ? "sticks out of it" : "overlaps ",
                sticks_out ? "" : name(o.volume, o.second).c_str(), o.depth, o.point.x, o.point.y,
                o.point.z);
  }
  std::printf("%zu overlaps and protrusions deeper than %g mm, %zu points a daughter\n",
              overlaps.size(), options.overlaps.tolerance, options.overlaps.resolution);
  return overlaps.empty() ? 0 : 1;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("check", "Find overlaps and protrusions");
  add_detector(command, options->detector);
  command
      .add_option("--resolution", options->overlaps.resolution,
                  "points on each daughter's surface (default: 1000)")
      ->transform(count(1, 100000000))
      ->option_text("N");
  command
      .add_option("--tolerance", options->overlaps.tolerance,
                  "mm; shallower ones are not told (default: 1e-6)")
      ->check(number(0, 1e12))
      ->option_text("MM");
  command.callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace navjit::apps
