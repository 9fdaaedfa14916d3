#include "common/gnuplot.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/child.hpp"
#include "files/output_file.hpp"
#include "navjit/errors.hpp"
#include "runtime/private_folder.hpp"

namespace navjit::common {
namespace {

std::string terminal_of(const std::string& file) {
  const std::string suffix = std::filesystem::path(file).extension();
  if (suffix == ".svg") return "svg size 900,600 font 'sans,14' background rgb 'white'";
  if (suffix == ".png") return "pngcairo size 900,600 font 'sans,11'";
  throw Error(file + ": pictures are .svg or .png files");
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
  throw Error(
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

std::string plot(const std::string& plots, const std::string& file) {
  const std::string program = find_gnuplot();
  const PrivateFolder folder;
  const TemporaryPath picture(folder.file("picture")), script(folder.file("script"));
  write_output(script.path(), "set terminal " + terminal_of(file) + "\nset output " +
                                  quoted(picture.path()) + "\n" + plots + "\nunset output\n");
  const ChildResult result = run_child({program, script.path()}, 60, WhenInterrupted::go_on);
  std::ifstream in(picture.path(), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!result.good() || bytes.empty()) {
    throw Error(file + ": gnuplot " + result.words(60));
  }
  return bytes;
}

}  // namespace navjit::common
