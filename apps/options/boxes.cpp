#include "apps/options/boxes.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

#include "navjit/errors.hpp"

namespace navjit::apps {

void parse_boxes(const std::string& text, GeometryOptions& options) {
  std::istringstream entries(text);
  for (std::string entry; std::getline(entries, entry, ',');) {
    const std::size_t equals = entry.rfind('=');
    const std::string name = equals == std::string::npos ? "" : entry.substr(0, equals);
    const std::string value = equals == std::string::npos ? entry : entry.substr(equals + 1);
    const std::optional<bvh::Structure> structure = bvh::parse_structure(value);
    if (!structure && value != "auto") {
      throw UsageError("'" + entry +
                       "': auto, linear, wide-tree, two-level or regular-tree is needed, the last "
                       "two with :surface, :k-means or :furthest if you like");
    }
    if (equals == std::string::npos || name == "*") {
      options.boxes = structure;
    } else if (structure) {
      options.boxes_of[name] = *structure;
    } else {
      options.boxes_of.erase(name);
    }
  }
}

void add_boxes(CLI::App& command, GeometryOptions& options) {
  command
      .add_option_function<std::string>(
          "--boxes",
          [&options](const std::string& text) {
            try {
              parse_boxes(text, options);
            } catch (const UsageError& error) {
              throw CLI::ValidationError("--boxes", error.what());
            }
          },
          "how daughters' boxes are searched: auto, linear, wide-tree, two-level\nor regular-tree, "
          "the last two with :surface, :k-means or :furthest")
      ->option_text("[VOLUME=]SEARCH,...");
}

}  // namespace navjit::apps
