#include "common/gnuplot.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "common/child.hpp"

namespace navjit::common {
namespace {

std::string terminal_of(const std::string& file) {
  const std::string suffix = std::filesystem::path(file).extension();
  if (suffix == ".svg") return "svg size 900,600 font 'sans,14' background rgb 'white'";
  if (suffix == ".png") return "pngcairo size 900,600 font 'sans,11'";
  throw std::runtime_error(file + ": pictures are .svg or .png files");
}

std::string find_gnuplot() {
  const char* path = std::getenv("PATH");
  std::string folders = path != nullptr ? path : "/usr/bin";
  for (std::size_t at = 0; at <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', at), folders.size());
    const std::string program = folders.substr(at, end - at) + "/gnuplot";
    if (access(program.c_str(), X_OK) == 0) return program;
    at = end + 1;
  }
  throw std::runtime_error(
      "pictures are drawn by gnuplot, which is not installed (Debian: "
      "gnuplot-nox)");
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c != '"' && c != '\\' && c != '`' && c != '\n' && c != '$') safe += c;
  }
  return '"' + safe + '"';
}

std::string literal(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void check_picture(const std::string& file) {
  terminal_of(file);
  find_gnuplot();
}

void plot(const std::string& plots, const std::string& file) {
  const std::string program = find_gnuplot();
  const std::filesystem::path absolute = std::filesystem::absolute(file);
  const std::string script = "set terminal " + terminal_of(file) + "\nset output " +
                             quoted(absolute.string()) + "\n" + plots + "\nunset output\n";
  std::string name = (std::filesystem::temp_directory_path() / "navjit_plot_XXXXXX").string();
  const int handle = mkstemp(name.data());
  if (handle < 0) throw std::runtime_error(name + ": cannot be written");
  close(handle);
  std::ofstream(name) << script;
  std::error_code ignored;
  std::filesystem::remove(absolute, ignored);  // so that what is there afterwards is the picture
  const ChildResult result = run_child({program, name}, 60);
  std::filesystem::remove(name, ignored);
  if (!result.good() || !std::filesystem::exists(absolute)) {
    throw std::runtime_error(file + ": gnuplot " + result.words(60));
  }
}

}  // namespace navjit::common
