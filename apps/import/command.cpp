// `navjit import`: a surface as CAD programs write it becomes a detector, and a ROOT geometry GDML.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/commands.hpp"
#include "apps/import/materials.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/outputs.hpp"
#include "common/choices.hpp"
#include "common/text.hpp"
#include "geometry/root/names.hpp"
#include "navjit/builder.hpp"
#include "navjit/gdml.hpp"
#include "navjit/root.hpp"
#include "navjit/surface.hpp"

namespace navjit::apps {
namespace {

const common::Choices<double> units{{"um", 1e-3}, {"mm", 1},    {"cm", 10},
                                    {"m", 1000},  {"in", 25.4}, {"ft", 304.8}};

struct Options {
  std::string file, out, name, setup;
  MaterialWish material{.name = "Aluminium"};
  MaterialWish world{.name = "Air"};
  double unit = 1;
};

/// Half lengths of a box about the origin with room about the surface, whose coordinates stay as
/// they are.
Vec3 world_of(const Extent& extent) {
  const auto half = [](double low, double high) {
    return std::max(std::abs(low), std::abs(high)) + 0.1 * (high - low);
  };
  return {half(extent.min.x, extent.max.x), half(extent.min.y, extent.max.y),
          half(extent.min.z, extent.max.z)};
}

int import_surface(const Options& options) {
  Output out(options.out);
  Surface surface = read_surface(options.file, {.unit = options.unit});
  // Files may be called anything, and XML cannot hold everything.
  const std::string name = root::readable(
      !options.name.empty() ? options.name : std::filesystem::path(options.file).stem().string());
  if (const std::string open = open_at(surface); !open.empty()) {
    throw SurfaceError(common::printable(options.file) + ": " + open +
                       "; close the surface in the program that wrote it");
  }
  for (const std::string& note : mend_shells(surface)) std::printf("note: %s\n", note.c_str());
  DetectorBuilder builder;
  const Solid solid = make_tessellated(name, surface);
  const auto inner = builder.volume(name, solid, add_material(builder, options.material));
  const Vec3 half = world_of(solid.extent);
  const auto world = builder.volume(
      "World", make_box("World", half.x, half.y, half.z),
      options.world.name == options.material.name ? 0 : add_material(builder, options.world));
  builder.place(inner, world, {}, 0, name);
  const Detector detector = builder.build(world);
  const double volume = capacity(solid) / 1000;
  std::printf("%zu triangles with %zu corners, from (%g, %g, %g) to (%g, %g, %g) mm, %g cm3",
              surface.triangles.size(), surface.corners.size(), solid.extent.min.x,
              solid.extent.min.y, solid.extent.min.z, solid.extent.max.x, solid.extent.max.y,
              solid.extent.max.z, volume);
  if (const double density = detector.material(detector.volume(inner)).density; density > 0) {
    std::printf(", %g g", density * volume);
  }
  std::printf(" of %s\n", common::printable(options.material.name).c_str());
  out.write([&] { return gdml_text(detector); });
  return 0;
}

/// Options that are for surfaces alone are refused, since they would not be heeded.
int import_geometry(const Options& options, const CLI::App& command) {
  for (const char* option :
       {"--unit", "--name", "--material", "--density", "--formula", "--world"}) {
    if (command.count(option) > 0) {
      throw UsageError(std::string(option) + " is for surfaces; " +
                       common::printable(options.file) + " is a ROOT file, leave it out");
    }
  }
  Output out(options.out);
  GdmlReport report;
  const Detector detector = read_root(options.file, {.key = options.setup}, &report);
  std::printf("%zu logical volumes, %zu materials, %llu touchables\n", detector.volumes(),
              detector.materials(), static_cast<unsigned long long>(detector.touchables()));
  for (const std::string& note : report.skipped) std::printf("note: %s\n", note.c_str());
  out.write([&] { return gdml_text(detector); });
  return 0;
}

int import_file(const Options& options, const CLI::App& command) {
  // A file .root that is none is refused as one, and not as a surface.
  if (is_root_file(options.file) || std::filesystem::path(options.file).extension() == ".root") {
    return import_geometry(options, command);
  }
  if (!options.setup.empty()) {
    throw UsageError("--setup is for ROOT files; " + common::printable(options.file) +
                     " is none, leave it out");
  }
  return import_surface(options);
}

}  // namespace

void add_import(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "import", "Write a ROOT geometry, or a surface (STL, OBJ) as a volume in a box, as GDML");
  command.add_option("file", options->file, "ROOT file with a TGeoManager, or file .stl or .obj")
      ->required()
      ->option_text("FILE");
  add_output(command, "-o,--out", options->out, "GDML file")->required();
  add_choice(command, "--unit", options->unit, units,
             "of a surface's numbers: um, mm (default), cm, m, in or ft")
      ->option_text("UNIT");
  command.add_option("--name", options->name, "of the volume (default: that of the file)")
      ->option_text("NAME");
  std::string names = "of the volume (default: Aluminium): a name of Geant4's (G4_...), or one of";
  for (const std::string& known : known_materials()) names += " " + known;
  command.add_option("--material", options->material.name, names)->option_text("NAME");
  command.add_option("--density", options->material.density, "of the material, g/cm3")
      ->check(number_above(0, 1e6))
      ->option_text("X");
  command.add_option("--formula", options->material.formula, "of the material: Al2O3")
      ->option_text("FORMULA");
  command.add_option("--world", options->world.name, "material of the box (default: Air)")
      ->option_text("NAME");
  command
      .add_option("--setup", options->setup, "which TGeoManager of a ROOT file (default: first)")
      ->option_text("NAME");
  command.callback([options, &command, &action] {
    refuse_same_files({{"-o", options->out}}, {{"the file to import", options->file}});
    action = [options, &command] { return import_file(*options, command); };
  });
}

}  // namespace navjit::apps
