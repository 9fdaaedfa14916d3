#include "apps/options/outputs.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>

#include "apps/options/numbers.hpp"

namespace navjit::apps {
namespace {

namespace fs = std::filesystem;

/// Whether two names are those of one file, or will be.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error)) {
    return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
  }
  const fs::path first = fs::weakly_canonical(a, error), second = fs::weakly_canonical(b, error);
  return !error && first == second;
}

}  // namespace

CLI::Option* add_output(CLI::App& command, const std::string& option, std::string& path,
                        const std::string& what, const std::string& value) {
  return command.add_option(option, path, what)->check(not_empty())->option_text(value);
}

CLI::Option* add_plot(CLI::App& command, const std::string& option, std::string& path,
                      const std::string& what) {
  return add_output(command, option, path, what, "FILE.svg|.png")
      ->check([](const std::string& file) {
        const std::string suffix = fs::path(file).extension();
        const bool known = suffix == ".svg" || suffix == ".png";
        return known ? std::string() : file + ": pictures are .svg or .png files";
      });
}

void refuse_same_files(std::initializer_list<NamedFile> written,
                       std::initializer_list<NamedFile> read) {
  for (const NamedFile* one = written.begin(); one != written.end(); ++one) {
    if (one->path.empty()) continue;
    const auto refuse = [&](const NamedFile& other) {
      if (other.path.empty() || !same_file(one->path, other.path)) return;
      throw CLI::ValidationError(one->option,
                                 "'" + one->path + "' is the file of " + other.option + ", too");
    };
    for (const NamedFile* other = one + 1; other != written.end(); ++other) refuse(*other);
    for (const NamedFile& other : read) refuse(other);
  }
}

void attempt_all(std::initializer_list<std::function<void()>> things) {
  std::exception_ptr failure;
  for (const auto& thing : things) {
    try {
      thing();
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace navjit::apps
