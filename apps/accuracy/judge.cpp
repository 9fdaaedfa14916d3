#include "apps/accuracy/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace navjit::accuracy {
namespace {

using reference::Chain;
using reference::Quad;
using reference::Verdict;
using reference::WideAnswer;
using reference::WideDirection;
using reference::WideGeometry;
using reference::WidePoint;

double ulp_of(double magnitude) {
  return std::nextafter(magnitude, std::numeric_limits<double>::infinity()) - magnitude;
}

WidePoint moved(const Vec3& p, const Vec3& v, Quad t) {
  return {p.x + t * v.x, p.y + t * v.y, p.z + t * v.z};
}

double size_of(const World& world) {
  const Extent& e = world.volumes[world.top].solid.extent;
  return std::max({std::abs(e.min.x), std::abs(e.min.y), std::abs(e.min.z), std::abs(e.max.x),
                   std::abs(e.max.y), std::abs(e.max.z)});
}

VolumeId volume_of(const World& world, const Chain& chain) {
  VolumeId volume = world.top;
  for (const std::uint32_t k : chain) volume = world.volumes[volume].daughters[k].volume;
  return volume;
}

/// Geant4 and VecGeom give reflected copies of a volume names of their own.
bool same_volume(const std::string& ours, const std::string& theirs) {
  return ours == theirs || theirs == ours + "_refl";
}

class RayJudge {
 public:
  RayJudge(const WideGeometry& reference, const Ray& ray, const MadeRay& made,
           const Tolerances& tolerances)
      : reference_(reference),
        world_(reference.world()),
        ray_(ray),
        made_(made),
        tolerances_(tolerances),
        direction_(reference::widen_direction(ray.direction)),
        backwards_(reference::widen_direction(-1.0 * ray.direction)) {
    result_.stuck = made.stuck;
  }

  JudgedRay run(bool named) {
    for (std::size_t i = 0; i < made_.steps.size(); ++i) {
      if (made_.steps[i].length < tolerances_.shortest) {
        ++result_.skipped;
      } else if (named) {
        judge_named(i);
      } else {
        judge(i);
      }
    }
    if (!made_.stuck && !ends_with_world()) {
      // Where the file lets a volume stick out of the world, rays end beyond the world's surface.
      result_.lost = !ends_in_protrusion();
      if (!result_.lost) ++result_.arguable;
    }
    return std::move(result_);
  }

 private:
  /// Whether a claim about a point is wrong, which it is only beyond the tolerance.
  bool refuted(const Chain& chain, const WidePoint& p) {
    return is_wrong(reference_.judge(chain, p, tolerances_.surface));
  }

  /// Whether a ray that is held to be in `chain` from `start` on, `end` far along `direction`, is
  /// in something else meanwhile. `first` is the reference's step from there. What the reference
  /// comes into is looked at one by one: a thin volume lies between any points chosen beforehand.
  bool passes_another(const Chain& chain, const WidePoint& start, const WideDirection& direction,
                      const WideAnswer& first, Quad end) {
    constexpr int most = 16;  // enough to refute a claim
    Quad at = first.length;
    WideAnswer answer = first;
    for (int n = 0; n < most && answer.inside && at < end; ++n) {
      const Chain passed = answer.next;
      answer = reference_.step(passed, kernels::advance(start, direction, at), direction);
      const Quad until = kernels::smaller(at + answer.length, end);
      if (refuted(chain, kernels::advance(start, direction, (at + until) / 2))) return true;
      at += answer.length;
    }
    return false;
  }

  void judge(std::size_t i) {
    const MadeStep& made = made_.steps[i];
    const Chain chain = reference::chain_of(world_, *made.touchable);
    const WidePoint start = reference::widen(made.point);
    const WideAnswer right = reference_.step(chain, start, direction_);
    JudgedStep judged = measure(i, chain, made.point, made.length, right.length, right);
    // What comes next is the claim that the next step starts with.
    const bool leaves = i + 1 == made_.steps.size() && !made_.stuck;
    const bool known = i + 1 < made_.steps.size();
    const Chain next = known ? reference::chain_of(world_, *made_.steps[i + 1].touchable) : Chain{};
    const bool same = leaves ? !right.inside : !known || (right.inside && next == right.next);
    if (i == 0) judged.wrong_volume = refuted(chain, middle(i));
    if (!same && known) {
      judged.wrong_volume = judged.wrong_volume || refuted(next, middle(i + 1));
    }
    if (!same && leaves) {
      judged.wrong_volume =
          judged.wrong_volume ||
          reference_.side_of_world(moved(made.point, ray_.direction, Quad(made.length)),
                                   tolerances_.surface) == Side::inside;
    }
    // The engine and the reference end the step at different points. Between these the engine
    // claims that the ray is still in this volume, or already in the next one, for as long as that
    // step lasts. Unless both are right, that is refuted there.
    if (judged.error > tolerances_.surface) {
      const Quad end = made.length;
      const bool beyond = end > right.length;
      const bool checkable = beyond || known;
      const Quad claimed =
          !beyond && known ? kernels::smaller(Quad(made_.steps[i + 1].length), right.length - end)
                           : right.length - end;
      for (const double part : {0.03125, 0.5, 0.96875}) {
        const WidePoint p = moved(made.point, ray_.direction, end + Quad(part) * claimed);
        judged.wrong_end =
            judged.wrong_end || (checkable && refuted(beyond ? chain : next, p)) ||
            (!checkable && reference_.side_of_world(p, tolerances_.surface) == Side::inside);
      }
      judged.wrong_end =
          judged.wrong_end || (beyond && passes_another(chain, start, direction_, right, end));
    }
    const bool differs = !same || judged.error > tolerances_.surface;
    if (differs && !judged.wrong_volume && !judged.wrong_end) argue(judged);
    result_.steps.push_back(judged);
  }

  /// Either is right: how far apart the two are is then no error.
  void argue(JudgedStep& judged) {
    ++result_.arguable;
    if (judged.error > tolerances_.surface) judged.measured = false;
  }

  bool is_called(const Chain& chain, const std::string& name) const {
    return same_volume(world_.volumes[volume_of(world_, chain)].name, name);
  }

  /// A touchable of this name with the point, among those about the one that the ray was in last.
  /// What sticks out of its mother is found only by those who were in it.
  std::optional<Chain> find_nearby(const std::string& name, const WidePoint& p) {
    for (Chain chain = last_;; chain.pop_back()) {
      if (is_called(chain, name) && !refuted(chain, p)) return chain;
      const auto& daughters = world_.volumes[volume_of(world_, chain)].daughters;
      for (std::uint32_t k = 0; k < daughters.size(); ++k) {
        if (!same_volume(world_.volumes[daughters[k].volume].name, name)) continue;
        Chain inner = chain;
        inner.push_back(k);
        if (!refuted(inner, p)) return inner;
      }
      if (chain.empty()) return std::nullopt;
    }
  }

  void judge_named(std::size_t i) {
    const MadeStep& made = made_.steps[i];
    Chain chain;
    const WidePoint p = middle(i);
    // Where volumes overlap or stick out it matters where the ray came from.
    bool found = true;
    if (expected_ && is_called(*expected_, made.volume) && !refuted(*expected_, p)) {
      chain = *expected_;
    } else {
      found = reference_.locate(p, direction_, chain);
      if (!found || !is_called(chain, made.volume)) {
        if (std::optional<Chain> other = find_nearby(made.volume, p)) {
          chain = *std::move(other);
          found = true;
        }
      }
    }
    expected_.reset();
    const bool sure = found && reference_.judge(chain, p, tolerances_.surface) == Verdict::right;
    const VolumeId volume = volume_of(world_, chain);
    if (!found || !is_called(chain, made.volume)) {
      const bool outside =
          !found && reference_.side_of_world(p, tolerances_.surface) == Side::outside;
      if (!sure && !outside) {
        ++result_.arguable;
        return;
      }
      result_.steps.push_back({i, volume, volume, false, 0, 1, 0, 0, true, false});
      return;
    }
    const WideAnswer right = reference_.step(chain, p, direction_);
    last_ = chain;
    if (right.inside) expected_ = right.next;
    const Quad half = Quad(made.length) / 2, length = half + right.length;
    JudgedStep judged = measure(i, chain, made.point, made.length, length, right);
    // The step is judged from its middle on; what it passed before that is found on the way back.
    const WideAnswer back = reference_.step(chain, p, backwards_);
    judged.wrong_end = back.length < half - tolerances_.surface &&
                       passes_another(chain, p, backwards_, back, half);
    if (judged.error > tolerances_.surface) {
      const bool beyond = Quad(made.length) > length;
      const WidePoint q = moved(made.point, ray_.direction, (Quad(made.length) + length) / 2);
      // Short of the surface, the engine claims that something else begins there.
      judged.wrong_end =
          judged.wrong_end ||
          (beyond ? refuted(chain, q) || passes_another(chain, p, direction_, right, half)
                  : reference_.judge(chain, q, tolerances_.surface) == Verdict::right &&
                        reference_.nearest_surface(chain, q) > tolerances_.surface);
      if (!judged.wrong_end) argue(judged);
    }
    result_.steps.push_back(judged);
  }

  JudgedStep measure(std::size_t i, const Chain& chain, const Vec3& start, double length,
                     Quad right, const WideAnswer& answer) {
    const double ulp = ulp_of(answer.magnitude);
    const double error = static_cast<double>(kernels::absolute(Quad(length) - right));
    double across = error;
    // Most steps are right to the last bits: what is more is worth another look.
    if (error > ulp) across = reference_.across(chain, start, ray_.direction, Quad(length), right);
    return {i,      volume_of(world_, chain),   answer.surface, true, error, ulp,
            across, static_cast<double>(right), false,          false};
  }

  WidePoint middle(std::size_t i) const {
    const MadeStep& made = made_.steps[i];
    return moved(made.point, ray_.direction, Quad(made.length) / 2);
  }

  /// The world ends where its solid does, or else the ray was dropped or carried on.
  bool ends_with_world() const {
    const double rounding = tolerances_.surface + static_cast<double>(made_.steps.size()) *
                                                      std::numeric_limits<double>::epsilon() *
                                                      size_of(world_);
    const WidePoint end = reference::widen(made_.steps.empty() ? ray_.position : made_.end);
    const Side side = reference_.side_of_world(end, rounding);
    return side == Side::surface || (side == Side::outside && made_.steps.empty());
  }

  /// Whether the ray's last volume sticks out of its mother where the ray ended outside of the
  /// world: on the way from the world's surface to there, or all along the last step.
  bool ends_in_protrusion() const {
    if (made_.steps.empty() ||
        reference_.side_of_world(reference::widen(made_.end), 0) != Side::outside) {
      return false;
    }
    const MadeStep& last = made_.steps.back();
    const Chain chain = last.touchable ? reference::chain_of(world_, *last.touchable) : last_;
    if (!last.touchable && !is_called(chain, last.volume)) return false;
    const Quad length = last.length;
    const Quad exit = kernels::smaller(reference_.exit(last.point, ray_.direction), length);
    for (const Quad t : {(exit + length) / 2, length / 2}) {
      const WidePoint p = moved(last.point, ray_.direction, t);
      if (reference_.judge(chain, p, tolerances_.surface) == Verdict::protrusion) return true;
    }
    return false;
  }

  const WideGeometry& reference_;
  const World& world_;
  const Ray& ray_;
  const MadeRay& made_;
  const Tolerances& tolerances_;
  WideDirection direction_, backwards_;
  // Of judge_named: the touchable that the ray was in last, as far as is known, and the one that
  // comes next by the reference.
  Chain last_;
  std::optional<Chain> expected_;
  JudgedRay result_;
};

}  // namespace

Tolerances own_tolerances(const World& world) { return {4 * world.tolerance}; }

Tolerances vecgeom_tolerances(const World& world) {
  constexpr double push = 1e-6;
  return {std::max(own_tolerances(world).surface, 2.2 * push), 10 * push};
}

JudgedRay judge_ray(const WideGeometry& reference, const Ray& ray, const MadeRay& made,
                    const Tolerances& tolerances) {
  return RayJudge(reference, ray, made, tolerances).run(false);
}

JudgedRay judge_named_ray(const WideGeometry& reference, const Ray& ray, const MadeRay& made,
                          const Tolerances& tolerances) {
  return RayJudge(reference, ray, made, tolerances).run(true);
}

}  // namespace navjit::accuracy
