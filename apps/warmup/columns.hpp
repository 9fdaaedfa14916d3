// What tables show of a variant's runs, in words: the same on a terminal and on a page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/warmup/experiment.hpp"

namespace navjit::warmup {

/// A figure over repetitions; those without a value are counted apart.
struct Over {
  Spread of;
  std::size_t with = 0, runs = 0;
};

template <class Get>
Over over(const VariantReport& report, Get&& get) {
  std::vector<double> values;
  for (const RunFigures& run : report.runs) {
    if (const std::optional<double> value = get(run)) values.push_back(*value);
  }
  return {spread(values), values.size(), report.runs.size()};
}

/// "1.23 (1.1 to 1.4)" or, where some have none, with how many had it: "1.23 (1.1 to 1.4), 2 of 3".
/// `none` where no run has it.
std::string words(const Over& over, const char* format, const char* none);

/// A field of a table.
struct Field {
  std::string text;
  std::optional<double> median{};  ///< to sort by
};

/// The headings of fields_of().
std::vector<std::string> headings();
/// Empty where the run without the JIT has nothing to tell; dashes if the variant was not run.
std::vector<Field> fields_of(const VariantReport& report);

}  // namespace navjit::warmup
