#include "tests/reference/trace.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "geometry/model/world.hpp"
#include "navjit/runtime.hpp"

namespace navjit::reference {
namespace {

struct CloseFile {
  void operator()(gzFile file) const { gzclose(file); }
};

/// A row of a trace file, as its four fields.
struct Row {
  std::size_t ray = 0;
  std::size_t step = 0;
  TraceStep made;
};

template <class Number>
bool parse(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Returns false if the text is not a row. Volume names hold no commas.
bool parse_row(std::string_view text, Row& row) {
  std::array<std::string_view, 4> fields;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 3)) return false;
    fields[i] = text.substr(0, comma);
    if (i < 3) text.remove_prefix(comma + 1);
  }
  if (!parse(fields[0], row.ray) || !parse(fields[1], row.step)) return false;
  row.made.volume = fields[2];
  row.made.stuck = fields[3] == "stuck";
  row.made.length = 0;
  return row.made.stuck || (parse(fields[3], row.made.length) && std::isfinite(row.made.length) &&
                            row.made.length >= 0);
}

/// A step without the slivers before it, or several steps that were merged.
struct Piece {
  const TraceStep* first = nullptr;
  std::size_t step = 0;  ///< number of `first`
  double length = 0;
};

/// The steps of a ray that count.
std::vector<Piece> pieces_of(const std::vector<TraceStep>& steps, const Criteria& criteria) {
  double total = 0;
  for (const TraceStep& step : steps) total += step.length;
  const double sliver = std::max(criteria.sliver, criteria.relative * total);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].stuck || steps[i].length >= sliver) {
      pieces.push_back({&steps[i], i, steps[i].length});
    }
  }
  return pieces;
}

std::vector<Piece> merge(const std::vector<Piece>& pieces) {
  std::vector<Piece> merged;
  for (const Piece& piece : pieces) {
    if (!merged.empty() && !piece.first->stuck &&
        merged.back().first->volume == piece.first->volume) {
      merged.back().length += piece.length;
    } else {
      merged.push_back(piece);
    }
  }
  return merged;
}

/// Geant4 gives reflected copies of a volume names of their own; the file has only the original's.
bool same_volume(const std::string& ours, const std::string& theirs) {
  return ours == theirs || theirs == ours + "_refl";
}

bool equal(const Piece& a, const Piece& b, const Criteria& criteria) {
  return !a.first->stuck && !b.first->stuck && same_volume(a.first->volume, b.first->volume) &&
         std::abs(a.length - b.length) <=
             std::max(criteria.length, criteria.relative * std::max(a.length, b.length));
}

/// Number of the first piece in which the two differ; npos if they are equal.
constexpr std::size_t npos = static_cast<std::size_t>(-1);
std::size_t mismatch(const std::vector<Piece>& a, const std::vector<Piece>& b,
                     const Criteria& criteria) {
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i >= a.size() || i >= b.size() || !equal(a[i], b[i], criteria)) return i;
  }
  return npos;
}

std::string in_words(const std::vector<Piece>& pieces, std::size_t i) {
  if (i >= pieces.size()) return "has left the world";
  const Piece& piece = pieces[i];
  if (piece.first->stuck) return "stuck in " + piece.first->volume;
  char text[64];
  std::snprintf(text, sizeof text, "%.17g mm in ", piece.length);
  return text + piece.first->volume;
}

bool is_stuck(const std::vector<TraceStep>& steps) { return !steps.empty() && steps.back().stuck; }

}  // namespace

Trace read_trace(const std::filesystem::path& path, std::size_t rays) {
  const auto fail = [&](std::size_t line, const std::string& what) {
    throw std::runtime_error(path.string() + ":" + std::to_string(line) + ": " + what);
  };
  const std::unique_ptr<gzFile_s, CloseFile> file(gzopen(path.c_str(), "rb"));
  if (!file) throw std::runtime_error(path.string() + ": cannot be opened");
  Trace trace(rays);
  Row row;
  char text[1024];
  std::size_t last_ray = 0;
  std::size_t line = 0;
  while (gzgets(file.get(), text, sizeof text) != nullptr) {
    ++line;
    std::string_view content(text);
    if (content.size() + 1 == sizeof text) fail(line, "the line is too long");
    while (content.ends_with('\n') || content.ends_with('\r')) content.remove_suffix(1);
    if (line == 1) {
      if (content != "ray,step,volume,length") fail(line, "not the header of a trace");
      continue;
    }
    if (!parse_row(content, row)) fail(line, "not a row ray,step,volume,length");
    if (row.ray >= rays) fail(line, "there are only " + std::to_string(rays) + " rays");
    auto& steps = trace[row.ray];
    if (row.ray < last_ray || row.step != steps.size()) fail(line, "out of order");
    if (is_stuck(steps)) fail(line, "a stuck ray goes on");
    last_ray = row.ray;
    steps.push_back(std::move(row.made));
  }
  int error = 0;
  const char* message = gzerror(file.get(), &error);
  if (error != Z_OK && error != Z_STREAM_END) fail(line, message);
  if (line == 0) fail(line, "the file is empty");
  return trace;
}

Trace make_trace(std::shared_ptr<const World> world, std::span<const Ray> rays, JitMode jit) {
  Runtime runtime(world, {.jit = jit});
  Navigator navigator = runtime.navigator();
  Trace trace(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    auto& steps = trace[i];
    const RayTotals totals =
        transport(navigator, rays[i], world->tolerance, [&](const State& state, double length) {
          steps.push_back({world->volumes[state.volume()].name, length, false});
        });
    if (totals.stuck) steps.push_back({steps.empty() ? "" : steps.back().volume, 0, true});
  }
  return trace;
}

double Comparison::agreement() const {
  return rays == 0 ? 1 : 1 - static_cast<double>(differing) / static_cast<double>(rays);
}

Comparison compare(const Trace& ours, const Trace& theirs, const Criteria& criteria,
                   std::size_t examples) {
  if (ours.size() != theirs.size()) {
    throw std::invalid_argument("compare: the traces are of " + std::to_string(ours.size()) +
                                " and " + std::to_string(theirs.size()) + " rays");
  }
  Comparison result;
  result.rays = ours.size();
  for (std::size_t ray = 0; ray < ours.size(); ++ray) {
    result.stuck += is_stuck(ours[ray]) ? 1 : 0;
    result.stuck_theirs += is_stuck(theirs[ray]) ? 1 : 0;
    auto a = pieces_of(ours[ray], criteria);
    auto b = pieces_of(theirs[ray], criteria);
    result.steps += a.size();
    if (mismatch(a, b, criteria) == npos) continue;
    a = merge(a);
    b = merge(b);
    const std::size_t at = mismatch(a, b, criteria);
    if (at == npos) {
      ++result.merged;
      continue;
    }
    ++result.differing;
    if (result.differences.size() == examples) continue;
    Difference difference{ray, at < a.size() ? a[at].step : ours[ray].size()};
    for (std::size_t i = 0; i < difference.step; ++i) difference.distance += ours[ray][i].length;
    difference.ours = in_words(a, at);
    difference.theirs = in_words(b, at);
    result.differences.push_back(std::move(difference));
  }
  return result;
}

std::ostream& operator<<(std::ostream& out, const Comparison& comparison) {
  out << comparison.rays << " rays, " << comparison.steps << " steps: " << comparison.differing
      << " rays differ, " << comparison.merged << " are equal after merging, " << comparison.stuck
      << " are stuck (" << comparison.stuck_theirs << " of theirs)";
  for (const Difference& d : comparison.differences) {
    out << "\n  ray " << d.ray << " step " << d.step << " at " << d.distance << " mm: ours "
        << d.ours << ", theirs " << d.theirs;
  }
  return out;
}

}  // namespace navjit::reference
