// Options whose values are numbers.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace navjit::apps {

/// A finite number from `low` to `high`.
CLI::Validator within(double low, double high);

/// "a,b,c": so many finite numbers with commas. Throws CLI::ValidationError, naming the option.
std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count);

/// --threads.
void add_threads(CLI::App& command, unsigned& threads);

}  // namespace navjit::apps
