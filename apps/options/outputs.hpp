// Files that a command writes at its end.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "common/output.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace navjit::apps {

/// An option for a file that is written. An empty name is wrong usage: a script whose variable is
/// not set would lose what it asked for.
CLI::Option* add_output(CLI::App& command, const std::string& option, std::string& path,
                        const std::string& what, const std::string& value = "FILE");

/// The same for a picture that gnuplot draws; another suffix than .svg or .png is wrong usage.
CLI::Option* add_plot(CLI::App& command, const std::string& option, std::string& path,
                      const std::string& what);

/// An option's name, and the file that it was given; empty: none.
struct NamedFile {
  const char* option;
  const std::string& path;
};

/// Throws CLI::ValidationError if a file that is written is another one that is written, or one
/// that is read: the last writer would win. Devices and pipes may be the same.
void refuse_same_files(std::initializer_list<NamedFile> written,
                       std::initializer_list<NamedFile> read = {});

using common::Output;

/// Does all of several things, whichever fails; then throws what the first one threw that failed.
void attempt_all(std::initializer_list<std::function<void()>> things);

}  // namespace navjit::apps
