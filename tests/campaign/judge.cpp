#include "tests/campaign/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/model/random.hpp"
#include "navjit/vector.hpp"
#include "tests/campaign/starts.hpp"

namespace navjit::campaign {
namespace {

using reference::Quad;
using reference::Verdict;

/// Points within so many tolerances of a surface count as on it: the point, the frames and the
/// surface have each a rounding, for which one tolerance stands.
constexpr double slack = 4;

double largest(const Extent& e) {
  return std::max({std::abs(e.min.x), std::abs(e.min.y), std::abs(e.min.z), std::abs(e.max.x),
                   std::abs(e.max.y), std::abs(e.max.z)});
}

struct Made {
  State state;
  Vec3 start;
  double from, length;
};

class RayJudge {
 public:
  RayJudge(Navigator& navigator, const reference::WideGeometry& reference, const Plan& plan,
           const Ray& ray, std::uint64_t index, Counts& counts, std::vector<Defect>& defects)
      : navigator_(navigator),
        reference_(reference),
        world_(reference.world()),
        plan_(plan),
        ray_(ray),
        index_(index),
        counts_(counts),
        defects_(defects) {}

  void run() {
    ++counts_.rays;
    std::vector<Made> steps;
    Vec3 point = ray_.position;
    double length = 0;
    const RayTotals totals =
        transport(navigator_, ray_, world_.tolerance, [&](const State& state, double step) {
          steps.push_back({state, point, length, step});
          // As transport() moves on.
          point.x += step * ray_.direction.x;
          point.y += step * ray_.direction.y;
          point.z += step * ray_.direction.z;
          length += step;
        });
    counts_.steps += steps.size();
    if (totals.stuck) {
      ++counts_.stuck;
      note("stuck", steps, steps.size() - 1);
      return;
    }
    if (steps.empty()) {
      ++counts_.outside;
      if (reference_.side_of_world(reference::widen(ray_.position), slack * world_.tolerance) ==
          Side::inside) {
        ++counts_.lost;
        defects_.size() < plan_.most_defects
            ? defects_.push_back({"start not found", ray_, index_, 0, "", 0, 0})
            : void();
      }
      return;
    }
    if (is_lost(point, length, steps.size())) {
      if (ends_in_protrusion(steps.back())) {
        ++counts_.points[static_cast<std::size_t>(Verdict::protrusion)];
      } else {
        ++counts_.lost;
        note("lost", steps, steps.size() - 1);
      }
    }
    std::mt19937_64 random(plan_.seed * 0x9e3779b97f4a7c15U + index_);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!(steps[i].length > world_.tolerance)) ++counts_.zero_steps;
      if (uniform(random, 0, 1) < plan_.checked) judge(steps, i, random);
    }
  }

 private:
  /// The world ends where its solid does, or else the ray was dropped or carried on.
  bool is_lost(const Vec3& end, double length, std::size_t steps) const {
    const double size = largest(world_.volumes[world_.top].solid.extent);
    const double rounding = slack * world_.tolerance + static_cast<double>(steps) *
                                                           std::numeric_limits<double>::epsilon() *
                                                           size;
    if (reference_.side_of_world(reference::widen(end), rounding) != Side::surface) return true;
    const double exit = static_cast<double>(reference_.exit(ray_.position, ray_.direction));
    if (std::abs(exit - length) <= 1e-9 * size + 1e3 * rounding) return false;
    // By an edge, a tangent or a face both ends may be right: not if the world went on after the
    // end of the ray, or the ray after that of the world.
    const double middle = (exit + length) / 2;
    const auto between = reference::along(ray_.position, ray_.direction, middle);
    return reference_.side_of_world(between, rounding) ==
           (length < exit ? Side::inside : Side::outside);
  }

  /// Whether the file lets a volume stick out of the world, and the ray left it there.
  bool ends_in_protrusion(const Made& last) const {
    const reference::Chain chain = reference::chain_of(world_, last.state.touchable());
    const double exit = static_cast<double>(reference_.exit(ray_.position, ray_.direction));
    for (const double t : {last.from + 0.5 * last.length, (exit + last.from + last.length) / 2}) {
      const auto p = reference::along(ray_.position, ray_.direction, t);
      if (reference_.judge(chain, p, slack * world_.tolerance) == Verdict::protrusion) return true;
    }
    return false;
  }

  void judge(const std::vector<Made>& steps, std::size_t i, std::mt19937_64& random) {
    const Made& step = steps[i];
    const double tolerance = world_.tolerance;
    if (!(step.length > 10 * tolerance)) return;
    ++counts_.checked;
    const reference::Chain chain = reference::chain_of(world_, step.state.touchable());
    // The middle, near both ends, and anywhere.
    const double end = std::min(step.length / 4, 1e3 * tolerance);
    for (const double t :
         {step.length / 2, end, step.length - end, step.length * uniform(random, 0, 1)}) {
      const auto p = reference::along(step.start, ray_.direction, t);
      const Verdict verdict = reference_.judge(chain, p, slack * tolerance);
      ++counts_.points[static_cast<std::size_t>(verdict)];
      if (is_wrong(verdict)) note(name_of(verdict), steps, i);
    }
    const double t = step.length / 2;
    const Vec3 p = step.start + t * ray_.direction;
    if (navigator_.safety(step.state, p) > t + slack * tolerance) {
      ++counts_.unsafe;
      note("safety too large", steps, i);
    }
  }

  void note(const char* what, const std::vector<Made>& steps, std::size_t i) {
    if (defects_.size() >= plan_.most_defects || steps.empty()) return;
    const Made& step = steps[i];
    defects_.push_back(
        {what, ray_, index_, i, path_of(world_, step.state.touchable()), step.from, step.length});
  }

  Navigator& navigator_;
  const reference::WideGeometry& reference_;
  const World& world_;
  const Plan& plan_;
  const Ray& ray_;
  std::uint64_t index_;
  Counts& counts_;
  std::vector<Defect>& defects_;
};

}  // namespace

Counts& Counts::operator+=(const Counts& o) {
  rays += o.rays;
  outside += o.outside;
  steps += o.steps;
  zero_steps += o.zero_steps;
  stuck += o.stuck;
  lost += o.lost;
  checked += o.checked;
  unsafe += o.unsafe;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += o.points[i];
  return *this;
}

std::uint64_t Counts::judged() const {
  return std::accumulate(points.begin(), points.end(), std::uint64_t{0});
}

std::uint64_t Counts::wrong() const {
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_wrong(static_cast<Verdict>(i))) wrong += points[i];
  }
  return wrong;
}

void run_ray(Navigator& navigator, const reference::WideGeometry& reference, const Plan& plan,
             std::uint64_t index, Counts& counts, std::vector<Defect>& defects) {
  const Ray ray = make_ray(reference.world(), plan.seed, index);
  RayJudge(navigator, reference, plan, ray, index, counts, defects).run();
}

}  // namespace navjit::campaign
