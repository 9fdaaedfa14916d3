#include "apps/accuracy/picture.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "apps/accuracy/child.hpp"

namespace navjit::accuracy {
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

/// In gnuplot's double quotes; what could end or steer the text is left out.
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

/// Errors are drawn on a logarithmic scale, which knows no zero: a hundredth of an ulp stands for
/// it.
constexpr double least = 0.01;

}  // namespace

void check_picture(const std::string& file) {
  terminal_of(file);
  find_gnuplot();
}

void draw(const ExperimentReport& report, const std::string& title, const std::string& file) {
  const std::string program = find_gnuplot();
  std::string data, plots;
  double slowest = 0;
  for (const EngineReport& engine : report.engines) {
    if (engine.ns_per_step <= 0 || engine.figures.all.errors.along_ulp.empty()) continue;
    const Quantiles q = quantiles(engine.figures.all.errors.along_ulp);
    const std::string block = "$e" + std::to_string(plots.size());
    data += block + " << EOD\n" + literal(engine.ns_per_step) + ' ' +
            literal(std::max(q.high, least)) + ' ' + literal(std::max(q.median, least)) + ' ' +
            literal(std::max(q.largest, least)) + "\nEOD\n";
    plots += (plots.empty() ? "plot " : ", ") + block +
             " using 1:2:3:4 with yerrorbars lw 2 pt 7 ps 1.5 title " + quoted(engine.name);
    slowest = std::max(slowest, engine.ns_per_step);
  }
  if (plots.empty()) throw std::runtime_error(file + ": nothing was measured that could be drawn");
  const std::filesystem::path absolute = std::filesystem::absolute(file);
  const std::string script =
      "set terminal " + terminal_of(file) + "\nset output " + quoted(absolute.string()) +
      "\nset title " + quoted(title) + " noenhanced\nset xlabel 'ns a step'\n" +
      "set ylabel 'error of the length, ulp of the coordinates: median, 99.9%, largest'\n" +
      "set logscale y\nset format y '10^{%L}'\nset xrange [0:" + literal(1.15 * slowest) +
      "]\nset grid\nset key top left\n" + data + plots + "\nunset output\n";
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

}  // namespace navjit::accuracy
