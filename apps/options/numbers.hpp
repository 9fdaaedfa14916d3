// Options whose values are numbers, or words that stand for something.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "common/choices.hpp"
#include "common/numbers.hpp"

namespace navjit::apps {

/// For ->transform(): a whole number, also written as 1e6. What is passed on is plain digits.
CLI::Validator count(std::uint64_t least = 1, std::uint64_t most = common::most_counted);

/// For ->check(): a finite decimal number from `low` to `high`, or above `low` and up to `high`.
CLI::Validator number(double low, double high);
CLI::Validator number_above(double low, double high);

/// "a,b,c": so many finite numbers with commas. Throws CLI::ValidationError, naming the option.
std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count);

/// --threads.
void add_threads(CLI::App& command, unsigned& threads);

/// For ->check(): any text but none.
CLI::Validator not_empty();

/// For ->check(): what RayStream takes, a file or a count.
CLI::Validator rays_or_count();

/// "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// For ->check(): one of some words, which the error lists.
CLI::Validator one_of(std::vector<std::string> words);

/// An option that takes one of some words, which stand for values.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Value& value,
                        const common::Choices<Value>& choices, const std::string& what) {
  std::vector<std::string> words;
  for (const auto& choice : choices) words.push_back(choice.first);
  CLI::Option* option = command.add_option_function<std::string>(
      name,
      [&value, choices](const std::string& text) {
        for (const auto& choice : choices) {
          if (choice.first == text) value = choice.second;
        }
      },
      what);
  return option->check(one_of(words));
}

}  // namespace navjit::apps
