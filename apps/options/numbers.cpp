#include "apps/options/numbers.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

CLI::Validator in_range(double low, double high, bool with_low) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        try {
          const double value = common::parse_number(text);
          if (value <= high && (with_low ? value >= low : value > low)) return "";
          return "'" + text + "' is not " + (with_low ? "from " : "above ") + shown(low) +
                 (with_low ? " to " : " and up to ") + shown(high);
        } catch (const UsageError& error) {
          return error.what();
        }
      },
      "");
}

}  // namespace

CLI::Validator count(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        try {
          text = std::to_string(common::parse_count(text, least, most));
          return "";
        } catch (const UsageError& error) {
          return error.what();
        }
      },
      "");
}

CLI::Validator not_empty() {
  return CLI::Validator(
      [](std::string& text) { return std::string(text.empty() ? "the value is empty" : ""); }, "");
}

CLI::Validator rays_or_count() {
  return CLI::Validator(
      [](std::string& text) {
        if (common::looks_like_number(text)) return count()(text);
        const bool path = text.find_first_of("./") != std::string::npos ||
                          (!text.empty() && access(text.c_str(), F_OK) == 0);
        return path ? std::string() : "'" + text + "' is not a whole number of rays, and no file";
      },
      "");
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  }
  return text;
}

CLI::Validator one_of(std::vector<std::string> words) {
  return CLI::Validator(
      [words = std::move(words)](std::string& text) {
        const bool found = std::find(words.begin(), words.end(), text) != words.end();
        return found ? std::string() : "'" + text + "' is not " + listed(words);
      },
      "");
}

CLI::Validator number(double low, double high) { return in_range(low, high, true); }
CLI::Validator number_above(double low, double high) { return in_range(low, high, false); }

std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    try {
      values.push_back(common::parse_number(text.substr(at, comma - at)));
    } catch (const UsageError& error) {
      throw CLI::ValidationError(option, error.what());
    }
    at = comma + 1;
  }
  if (values.size() != count) {
    throw CLI::ValidationError(option, std::to_string(count) + " numbers with commas are needed");
  }
  return values;
}

void add_threads(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "navigating threads (default: 1)")
      ->transform(count(1, 1024))
      ->option_text("T");
}

}  // namespace navjit::apps
