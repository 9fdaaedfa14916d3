// `navjit trace`: every step of every ray, as CSV.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/basket.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/observe.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"
#include "common/interruption.hpp"
#include "common/ordered_chunks.hpp"
#include "common/parallel.hpp"
#include "common/text.hpp"
#include "files/output_file.hpp"
#include "navjit/errors.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport_basket.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  RayOptions rays;
  unsigned threads = 1;
  std::size_t basket = 0;  ///< 0: rays one by one
  Observation observation;
  RuntimeOptions runtime;
  std::string out;  ///< empty: standard output
};

/// Rays traced as one piece of work, and written as one.
constexpr std::size_t rays_per_chunk = 64;
/// Pieces that may be under way for each thread: rays differ in length.
constexpr std::uint64_t chunks_per_thread = 8;

struct Work {
  std::uint64_t first = 0;  ///< number of the first ray
  std::vector<Ray> rays;
};

struct Rows {
  std::string text;
  std::uint64_t rays = 0, outside = 0;
};

/// Where the rows go: a file, or standard output.
class Sink {
 public:
  explicit Sink(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  void write(const std::string& text) {
    if (file_) {
      file_->write(text);
    } else if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
      throw Error(std::string("standard output cannot be written: ") + std::strerror(errno));
    }
  }
  void finish() {
    if (file_) file_->finish();
  }

 private:
  std::optional<OutputFile> file_;
};

/// Names of volumes as fields of a CSV file.
std::vector<std::string> fields_of(const World& world) {
  std::vector<std::string> fields;
  fields.reserve(world.volumes.size());
  for (const LogicalVolume& volume : world.volumes)
    fields.push_back(common::csv_field(volume.name));
  return fields;
}

/// The rows of one ray. `fields` has the names of the volumes.
class RayRows {
 public:
  RayRows(const std::vector<std::string>& fields, std::uint64_t number)
      : fields_(fields), number_(std::to_string(number)) {}

  void add(const State& state, double length) {
    char text[64];
    std::snprintf(text, sizeof text, "%.17g", length);
    row(fields_[state.volume()], text);
    last_ = state;
  }
  /// Appends them to those of the rays before.
  void end(const RayTotals& totals, Rows& rows) {
    if (totals.stuck) row(last_.inside() ? fields_[last_.volume()] : "", "stuck");
    rows.text += text_;
    ++rows.rays;
    rows.outside += totals.steps == 0 && !totals.stuck ? 1 : 0;
  }

 private:
  void row(const std::string& volume, const char* length) {
    text_ += number_ + ',' + std::to_string(step_++) + ',' + volume + ',' + length + '\n';
  }

  const std::vector<std::string>& fields_;
  std::string number_, text_{};
  std::size_t step_ = 0;
  State last_{};
};

/// The rows of a piece of work; of fewer rays once `go_on()` says no.
template <class GoOn>
Rows trace_one_by_one(ObservedNavigator navigator, double tolerance,
                      const std::vector<std::string>& fields, const Work& work, GoOn&& go_on) {
  Rows rows;
  while (rows.rays < work.rays.size() && go_on()) {
    RayRows ray(fields, work.first + rows.rays);
    const auto totals = transport(navigator, work.rays[rows.rays], tolerance,
                                  [&](const State& state, double l) { ray.add(state, l); });
    ray.end(totals, rows);
  }
  return rows;
}
template <class GoOn>
Rows trace_in_basket(Basket& basket, const ObservedDetector& seen, double tolerance,
                     const std::vector<std::string>& fields, const Work& work, GoOn&& go_on) {
  std::vector<RayRows> rays;
  for (std::size_t i = 0; i < work.rays.size(); ++i) rays.emplace_back(fields, work.first + i);
  const auto sink = [&](std::size_t ray, const State& state, double l) { rays[ray].add(state, l); };
  const auto totals = transport_in_basket(
      basket, work.rays, tolerance, sink, go_on,
      [&](const State& from, const State& to) { return seen.counts(from.volume(), to.volume()); });
  Rows rows;
  for (std::size_t i = 0; i < totals.size(); ++i) rays[i].end(totals[i], rows);
  return rows;
}

int trace(const Options& options) {
  Sink sink(options.out);
  const auto detector = read(options.detector);
  common::check_origin(options.rays.source, detector);
  const World& world = *detector;
  const ObservedDetector seen(detector, options.observation);
  log_observation(seen);
  Runtime runtime(seen.detector(), options.runtime);
  const std::vector<std::string> fields = fields_of(world);
  common::RayStream stream(options.rays.rays, options.rays.source, world);
  const common::Interruptible interruptible;
  sink.write("ray,step,volume,length\n");

  std::uint64_t asked = 0;
  Rows all;
  common::OrderedChunks<Work, Rows> chunks(
      chunks_per_thread * options.threads,
      [&]() -> std::optional<Work> {
        Work work{asked, stream.next(std::max(rays_per_chunk, 4 * options.basket))};
        asked += work.rays.size();
        return work.rays.empty() ? std::nullopt : std::optional(std::move(work));
      },
      [&](Rows&& rows) {
        sink.write(rows.text);
        all.rays += rows.rays;
        all.outside += rows.outside;
      });
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> differences{0};
  common::in_parallel(options.threads, stop, [&] {
    // Whoever ends wakes those that wait for work; whoever fails leaves a gap that nobody fills.
    struct AtTheEnd {
      decltype(chunks)& all;
      ~AtTheEnd() { all.stop(); }
    } const at_the_end{chunks};
    Navigator navigator = runtime.navigator();
    std::optional<Basket> basket;
    if (options.basket > 0) basket.emplace(runtime.basket(options.basket));
    const auto go_on = [&] { return common::interruption() == 0 && !stop; };
    while (auto piece = chunks.take()) {
      const Work& work = piece->work;
      Rows rows = basket
                      ? trace_in_basket(*basket, seen, world.tolerance, fields, work, go_on)
                      : trace_one_by_one({seen, navigator}, world.tolerance, fields, work, go_on);
      const bool complete = rows.rays == work.rays.size();
      chunks.give(piece->number, std::move(rows), complete);
      if (!complete) break;
    }
    differences += (basket ? basket->counts() : navigator.counts()).differences;
  });
  sink.finish();
  if (all.outside > 0) {
    std::fprintf(stderr, "navjit: %llu of %llu rays start outside the world and have no rows\n",
                 static_cast<unsigned long long>(all.outside),
                 static_cast<unsigned long long>(all.rays));
  }
  if (differences > 0) {
    throw Error(std::to_string(differences.load()) +
                " steps differed from the generic navigator's");
  }
  return 0;
}

}  // namespace

void add_trace(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("trace", "Write every step of every ray");
  add_detector(command, options->detector);
  add_rays(command, options->rays);
  command.get_option("--rays")->required();
  add_output(command, "--out", options->out, "CSV file (default: standard output)");
  add_threads(command, options->threads);
  add_observe(command, options->observation);
  add_basket(command, options->basket);
  add_runtime_options(command, options->runtime);
  command.callback([options, &action] {
    refuse_same_files({{"--out", options->out}}, {{"the detector", options->detector.file},
                                                  {"--rays", options->rays.file()},
                                                  {"--plugin", options->runtime.plugin}});
    action = [options] { return trace(*options); };
  });
}

}  // namespace navjit::apps
