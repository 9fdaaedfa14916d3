// `navjit profile`: profiles of several runs made into one.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/outputs.hpp"
#include "files/output_file.hpp"
#include "navjit/errors.hpp"
#include "navjit/step_profile.hpp"

namespace navjit::apps {
namespace {

struct Options {
  std::vector<std::string> profiles;
  std::string out;
};

int merge_profiles(const Options& options) {
  OutputFile out(options.out);
  StepProfile merged = read_profile(options.profiles.at(0));
  for (std::size_t i = 1; i < options.profiles.size(); ++i) {
    const StepProfile next = read_profile(options.profiles[i]);
    try {
      merged = merge(merged, next);
    } catch (const Error& error) {
      throw Error(options.profiles[0] + ", " + options.profiles[i] + ": " + error.what());
    }
  }
  out.write(profile_text(merged));
  out.finish();
  std::printf("%zu volumes, %llu runs\n", merged.volumes.size(),
              static_cast<unsigned long long>(merged.runs));
  return 0;
}

}  // namespace

void add_profile(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("profile", "Profiles of several runs");
  command.require_subcommand(1);
  CLI::App& merging = *command.add_subcommand("merge", "add profiles up");
  merging.add_option("profiles", options->profiles, "files")->check(not_empty())->required();
  add_output(merging, "-o,--out", options->out, "file to write")->required();
  merging.callback([options, &action] {
    for (const std::string& read : options->profiles) {
      refuse_same_files({{"-o", options->out}}, {{"a profile to add", read}});
    }
    action = [options] { return merge_profiles(*options); };
  });
}

}  // namespace navjit::apps
