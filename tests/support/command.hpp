// Runs the navjit command as a user would.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace navjit::tests {

struct Output {
  int status;
  std::string text;  ///< standard output and error together
};

/// Runs "PROGRAM ARGUMENTS" through the shell.
inline Output run_command(const std::string& program, const std::string& arguments) {
  // The user's cache is none of the tests' business.
  setenv("NAVJIT_CACHE", "off", 0);
  const std::string command = program + " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("popen failed");
  Output output{0, {}};
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    output.text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  output.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

/// The navjit command; NAVJIT_COMMAND is set by the build.
inline Output run_navjit(const std::string& arguments) {
  return run_command(NAVJIT_COMMAND, arguments);
}

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path.string() + " cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace navjit::tests
