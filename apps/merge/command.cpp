// `navjit report`: reports of several runs made into one.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/commands.hpp"
#include "apps/merge/reports.hpp"
#include "apps/options/machine.hpp"
#include "apps/options/outputs.hpp"
#include "common/text.hpp"
#include "files/output_file.hpp"
#include "geometry/input_file.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

struct Options {
  std::vector<std::string> reports;
  std::string out;
};

int merge_files(const Options& options) {
  OutputFile out(options.out);
  ReportMerger merger;
  for (const std::string& path : options.reports) {
    const Expected<std::string> text =
        read_regular_file(path, std::size_t{64} << 20, "it is too long for a report");
    if (!text) throw Error(common::printable(path) + ": cannot be read: " + text.failure().message);
    try {
      merger.add(nlohmann::json::parse(*text, nullptr, false));
    } catch (const Error& error) {
      throw Error(common::printable(path) + ": " + error.what());
    }
  }
  const nlohmann::ordered_json merged = merger.merged();
  out.write(report_text(merged));
  out.finish();
  std::printf("%zu reports: %llu rays, %llu steps%s\n", options.reports.size(),
              merged["rays"].get<unsigned long long>(), merged["steps"].get<unsigned long long>(),
              merger.missing().c_str());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("report", "Reports of several runs");
  command.require_subcommand(1);
  CLI::App& merging = *command.add_subcommand("merge", "make one report of those of parts");
  merging.add_option("reports", options->reports, "files of navjit run --report")->required();
  add_output(merging, "-o,--out", options->out, "file to write")->required();
  merging.callback([options, &action] {
    for (const std::string& read : options->reports) {
      refuse_same_files({{"-o", options->out}}, {{"a report to merge", read}});
    }
    action = [options] { return merge_files(*options); };
  });
}

}  // namespace navjit::apps
