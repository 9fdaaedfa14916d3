#include "apps/warmup/columns.hpp"

#include <cstdio>

namespace navjit::warmup {
namespace {

using Value = std::optional<double>;

struct Column {
  const char* heading;
  const char* format;
  const char* none;    ///< where no run has a value
  const char* of_off;  ///< of the run without the JIT; null: like all others
  Value (*value)(const RunFigures&);
};

const Column columns[] = {
    {"M steps/s, whole run", "%.2f", "-", nullptr,
     [](const RunFigures& r) { return Value(r.steps_per_second / 1e6); }},
    {"speed-up in the end", "%.2f", "-", "1", [](const RunFigures& r) { return r.speed_up; }},
    {"break-even, s", "%.2f", "never", "", [](const RunFigures& r) { return r.break_even_s; }},
    {"50% of steps specialised, s", "%.3f", "never", "",
     [](const RunFigures& r) { return r.half_s; }},
    {"90%, s", "%.3f", "never", "", [](const RunFigures& r) { return r.most_s; }},
    {"share in the end, %", "%.0f", "-", "",
     [](const RunFigures& r) { return Value(100 * r.share); }},
    {"cost, s of processor", "%.2f", "-", nullptr,
     [](const RunFigures& r) { return Value(r.record.other_s); }},
};

}  // namespace

std::string words(const Over& over, const char* format, const char* none) {
  if (over.with == 0) return none;
  char number[3][32];
  std::snprintf(number[0], sizeof number[0], format, over.of.median);
  std::snprintf(number[1], sizeof number[1], format, over.of.low);
  std::snprintf(number[2], sizeof number[2], format, over.of.high);
  std::string text = std::string(number[0]) + " (" + number[1] + " to " + number[2] + ")";
  if (over.with < over.runs) {
    text += ", " + std::to_string(over.with) + " of " + std::to_string(over.runs);
  }
  return text;
}

std::vector<std::string> headings() {
  std::vector<std::string> all;
  for (const Column& column : columns) all.emplace_back(column.heading);
  return all;
}

std::vector<Field> fields_of(const VariantReport& report) {
  std::vector<Field> fields;
  for (const Column& column : columns) {
    if (report.runs.empty()) {
      fields.push_back({"-"});
    } else if (report.variant.mode == Mode::off && column.of_off != nullptr) {
      fields.push_back({column.of_off});
    } else {
      const Over all = over(report, column.value);
      fields.push_back({words(all, column.format, column.none),
                        all.with > 0 ? Value(all.of.median) : std::nullopt});
    }
  }
  return fields;
}

}  // namespace navjit::warmup
