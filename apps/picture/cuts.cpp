#include "apps/picture/cuts.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "common/numbers.hpp"
#include "navjit/errors.hpp"

namespace navjit::picture {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

HalfSpace parse_half_space(std::string_view text) {
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || (text[1] != '<' && text[1] != '>')) {
    throw UsageError("'" + std::string(text) + "' is no half of space, as x>0 or z<-12.5 (mm) are");
  }
  const double sign = text[1] == '>' ? 1 : -1;
  const double value = common::parse_number(text.substr(2));
  const Vec3 normal{text[0] == 'x' ? sign : 0, text[0] == 'y' ? sign : 0,
                    text[0] == 'z' ? sign : 0};
  return {normal, sign * value};
}

/// Where the ray is in the cut; from >= to if nowhere.
Gap gap_of(const Cut& cut, const Ray& ray) {
  Gap gap{0, infinity, {0, 0, 0}};
  for (const HalfSpace& half : cut) {
    const double along = dot(half.normal, ray.direction);
    const double inside = dot(half.normal, ray.position) - half.offset;
    if (along == 0) {
      if (!(inside > 0)) return {0, 0, {}};
    } else if (along > 0) {
      gap.from = std::max(gap.from, -inside / along);
    } else if (-inside / along < gap.to) {
      gap.to = -inside / along;
      gap.face = half.normal;
    }
  }
  return gap;
}

}  // namespace

Cut parse_cut(std::string_view text) {
  Cut cut;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    cut.push_back(parse_half_space(text.substr(at, comma - at)));
    at = comma + 1;
  }
  return cut;
}

std::vector<Gap> gaps_of(const std::vector<Cut>& cuts, const Ray& ray) {
  std::vector<Gap> gaps;
  for (const Cut& cut : cuts) {
    const Gap gap = gap_of(cut, ray);
    if (gap.from < gap.to) gaps.push_back(gap);
  }
  std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.from < b.from; });
  std::size_t kept = 0;
  for (const Gap& gap : gaps) {
    if (kept > 0 && gap.from <= gaps[kept - 1].to) {
      if (gap.to > gaps[kept - 1].to) gaps[kept - 1] = {gaps[kept - 1].from, gap.to, gap.face};
    } else {
      gaps[kept++] = gap;
    }
  }
  gaps.resize(kept);
  return gaps;
}

}  // namespace navjit::picture
