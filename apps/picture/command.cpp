// `navjit picture`: what a detector looks like, what rays go through, and where their time goes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/runtime.hpp"
#include "apps/picture/make.hpp"
#include "common/progress_line.hpp"
#include "common/text.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

using picture::ColourBy;
using picture::Mode;

struct Options {
  Detector detector;
  std::string out;
  std::string size;  ///< empty: the mode's
  picture::Request request;
  unsigned threads = 1;
};

const common::Choices<Mode> modes{{"surface", Mode::surface},      {"path", Mode::path},
                                  {"x0", Mode::radiation_lengths}, {"mass", Mode::mass},
                                  {"steps", Mode::steps},          {"time", Mode::time}};
const common::Choices<ColourBy> colours{
    {"volume", ColourBy::volume}, {"material", ColourBy::material}, {"density", ColourBy::density}};

/// "800x600".
std::pair<int, int> parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  try {
    if (x == std::string::npos) throw UsageError("");
    return {static_cast<int>(common::parse_count(text.substr(0, x), 1, picture::most_pixels)),
            static_cast<int>(common::parse_count(text.substr(x + 1), 1, picture::most_pixels))};
  } catch (const UsageError&) {
    throw CLI::ValidationError("--size", "'" + text + "' is not WIDTHxHEIGHT, each from 1 to " +
                                             std::to_string(picture::most_pixels) + " pixels");
  }
}

bool is_svg(const std::string& file) {
  const std::string suffix = std::filesystem::path(file).extension();
  if (suffix != ".svg" && suffix != ".png") {
    throw CLI::ValidationError("-o", file + ": pictures are .svg or .png files");
  }
  return suffix == ".svg";
}

void print_summary(const std::string& file, const picture::Made& made, double seconds) {
  std::printf("%s: %d x %d pixels, %.2f s\n", common::printable(file).c_str(), made.width,
              made.height, seconds);
  for (const std::string& line : made.lines) std::printf("%s\n", line.c_str());
  if (made.sheet.entries.empty()) return;
  std::printf("\n%-7s %8s  %s\n", "colour", "pixels", "what");
  for (std::size_t i = 0; i < made.sheet.entries.size(); ++i) {
    const auto& [colour, meaning] = made.sheet.entries[i];
    std::printf("#%02x%02x%02x %7.2f%%  %s\n", colour.red, colour.green, colour.blue,
                100 * made.shares[i], common::printable(meaning).c_str());
  }
}

int draw(const Options& options) {
  Output output(options.out);
  const auto start = std::chrono::steady_clock::now();
  picture::Request request = options.request;
  request.frame.threads = options.threads;
  const auto world = read(options.detector);
  picture::Made made;
  {
    common::ProgressLine line("picture", static_cast<std::uint64_t>(picture::rows_of(request)));
    request.frame.progress = [&](int rows) { line.at(static_cast<std::uint64_t>(rows)); };
    made = picture::make(world, request);
  }
  output.write([&] {
    return is_svg(options.out) ? picture::svg_sheet(made.sheet) : picture::png_sheet(made.sheet);
  });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  print_summary(options.out, made, took.count());
  return 0;
}

Vec3 vector_of(const std::string& option, const std::string& text) {
  const std::vector<double> v = numbers(option, text, 3);
  return {v[0], v[1], v[2]};
}

CLI::Option* add_vector(CLI::App& command, const std::string& name, std::optional<Vec3>& value,
                        const std::string& what) {
  return command
      .add_option_function<std::string>(
          name, [name, &value](const std::string& text) { value = vector_of(name, text); }, what)
      ->option_text("X,Y,Z");
}

void add_view_options(CLI::App& command, picture::ViewOptions& view) {
  CLI::Option* from = command.add_option("--view", view.from, "from where: +x, -x, ..., or corner")
                          ->check(one_of({"+x", "-x", "+y", "-y", "+z", "-z", "corner"}))
                          ->option_text("SIDE");
  add_vector(command, "--eye", view.eye, "perspective, from a point, mm")->excludes(from);
  add_vector(command, "--at", view.at, "what is in the middle, mm (default: of what is seen)");
  add_vector(command, "--up", view.up, "what is up (default: +y, or +x where one looks along y)");
  CLI::Option* fov =
      command.add_option("--fov", view.fov, "perspective, of so many degrees across (default: 40)")
          ->check(number_above(0, 175))
          ->option_text("DEG");
  command
      .add_option("--width", view.width, "mm across, without perspective (default: all is seen)")
      ->check(number_above(0, 1e12))
      ->excludes(fov)
      ->excludes("--eye")
      ->option_text("MM");
}

void add_cut_options(CLI::App& command, picture::Request& request) {
  const auto parsed = [](const char* option, const std::string& text) {
    try {
      return picture::parse_cut(text);
    } catch (const UsageError& error) {
      throw CLI::ValidationError(option, error.what());
    }
  };
  CLI::Option* cut = command
                         .add_option_function<std::vector<std::string>>(
                             "--cut",
                             [&request, parsed](const std::vector<std::string>& texts) {
                               for (const std::string& text : texts)
                                 request.frame.cuts.push_back(parsed("--cut", text));
                             },
                             "cut away what is there: x>0 or, where all of them hold, x>0,y>0 (mm)")
                         ->allow_extra_args(false)
                         ->option_text("WHERE");
  command
      .add_option_function<std::string>(
          "--slice",
          [&request, parsed](const std::string& text) {
            const bool good = text.size() > 2 && text[1] == '=';
            if (!good) throw CLI::ValidationError("--slice", "'" + text + "' is not as z=100 (mm)");
            request.slice = parsed("--slice", std::string{text[0], '>'} + text.substr(2)).front();
          },
          "what is on a plane: z=100 (mm)")
      ->excludes(cut)
      ->excludes("--view")
      ->excludes("--eye")
      ->excludes("--fov")
      ->option_text("WHERE");
}

}  // namespace

void add_picture(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("picture", "Draw a detector, or what rays meet in it");
  add_detector(command, options->detector);
  command
      .add_option_function<std::string>(
          "-o",
          [options](const std::string& file) {
            is_svg(file);
            options->out = file;
          },
          "PNG or SVG file")
      ->required()
      ->option_text("FILE");
  picture::Request& request = options->request;
  command.add_option("--size", options->size, "of a view, pixels (default: 800x600)")
      ->option_text("WxH");
  CLI::Option* mode =
      add_choice(command, "--mode", request.mode, modes,
                 "surface, or of each ray: path (mm in what is opaque), x0 (radiation lengths), "
                 "mass (g/cm2), steps, time (ns, before and after specialisation)")
          ->option_text("MODE");
  CLI::Option* colour = add_choice(command, "--colour", request.colour, colours,
                                   "of surfaces: by volume, material or density")
                            ->option_text("BY");
  add_view_options(command, request.view);
  add_cut_options(command, request);
  command
      .add_option("--hide", request.show.hide,
                  "volumes or materials to be passed (* and ? are any)")
      ->allow_extra_args(false)
      ->option_text("NAME");
  command.add_option("--show", request.show.show, "the same to be seen, although gases")
      ->allow_extra_args(false)
      ->option_text("NAME");
  command
      .add_option("--only", request.show.only, "volumes; nothing beside them and what is in them")
      ->allow_extra_args(false)
      ->option_text("NAME");
  command.add_flag("--flat", request.flat, "colours as they are, without light and lines");
  command.add_flag("--log", request.logarithmic, "logarithmic scale of numbers");
  command.add_flag_callback(
      "--no-legend", [options] { options->request.legend = false; }, "the view alone");
  add_threads(command, options->threads);
  add_cache_option(command, request.runtime.cache, true);
  command.callback([options, mode, colour, &action] {
    refuse_same_files({{"-o", options->out}}, {{"the detector", options->detector.file}});
    picture::Request& asked = options->request;
    const bool surface = asked.mode == Mode::surface;
    if (asked.mode == Mode::time)
      std::tie(asked.frame.width, asked.frame.height) = std::pair(400, 300);
    if (!options->size.empty()) {
      std::tie(asked.frame.width, asked.frame.height) = parse_size(options->size);
    }
    if (!surface && (colour->count() > 0 || asked.flat || asked.slice)) {
      throw CLI::ValidationError("--mode", mode->as<std::string>() +
                                               " has no surfaces: --colour, --flat and --slice are "
                                               "for those");
    }
    if (surface && asked.logarithmic)
      throw CLI::ValidationError("--log", "needs a --mode of numbers");
    if (asked.mode == Mode::steps || asked.mode == Mode::time) {
      const char* const everything = "rays pass everything with this --mode";
      if (!asked.frame.cuts.empty()) throw CLI::ValidationError("--cut", everything);
      if (!asked.show.hide.empty()) throw CLI::ValidationError("--hide", everything);
    }
    action = [options] { return draw(*options); };
  });
}

}  // namespace navjit::apps
