#include "apps/options/numbers.hpp"

#include <cmath>
#include <cstdlib>

namespace navjit::apps {

CLI::Validator within(double low, double high) {
  // CLI::Range lets through what is no number.
  return CLI::Validator(
      [low, high](std::string& text) {
        double value = 0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return good
                   ? std::string()
                   : text + " is not within " + std::to_string(low) + " to " + std::to_string(high);
      },
      "");
}

std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string field = text.substr(at, comma - at);
    char* end = nullptr;
    values.push_back(std::strtod(field.c_str(), &end));
    if (field.empty() || *end != '\0' || !std::isfinite(values.back())) {
      throw CLI::ValidationError(option, "'" + field + "' is not a finite number");
    }
    at = comma + 1;
  }
  if (values.size() != count) {
    throw CLI::ValidationError(option, std::to_string(count) + " numbers with commas are needed");
  }
  return values;
}

void add_threads(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "navigating threads")
      ->check(CLI::Range(1U, 1024U))
      ->option_text("T");
}

}  // namespace navjit::apps
