// How a scene is navigated: the one template of all navigators that are not generic. Its parts are
// types (frame, mother's solid, daughters, search), its numbers are data: a struct in memory, or
// constants that fold. Gives the bits of the generic navigator, and leaves to it (a negative
// result) only steps of length zero, which are relocated with more care than pays here.
namespace navjit::kernels {

/// Of a daughter: a box within which tracks leave it, and the neighbours, the only ones that can
/// contain such a point (navjit::NeighbourLists). A cache line. In single precision the box would
/// not hold the points on its own faces, where tracks leave it.
struct alignas(64) CompactNeighbourList {
  double low[3], high[3];
  unsigned first;
  unsigned short count;
  unsigned short mother_contains;  ///< all of the box

  static constexpr unsigned short unlisted = 0xffff;
};

inline bool is_there(const CompactNeighbourList& a, const Vec3<double>& p) {
  return (p.x >= a.low[0]) & (p.x <= a.high[0]) & (p.y >= a.low[1]) & (p.y <= a.high[1]) &
         (p.z >= a.low[2]) & (p.z <= a.high[2]);
}

template <class Frame, class Mother, class Daughters, class Search>
struct Scene {
  using frame_type = Frame;
  double tolerance;
  Frame frame;
  Mother mother;
  Daughters daughters;
  Search search;
  const CompactNeighbourList* lists;  ///< by daughter; null: not used
  const unsigned* neighbours;         ///< of daughters, as `lists` counts them
  NearBoxes boxes;  ///< of daughters, for safety; without blocks every one is asked
};

/// Into the daughter just pushed, and further down.
template <class S>
[[gnu::always_inline]] inline void descend_into(const S& s, NavigationStack* stack,
                                                const Context* context, unsigned k, double x,
                                                double y, double z) {
  const auto& d = s.daughters.at[k];
  if (d.leaf) return;
  relocate_in_table(stack, context, d.volume, x, y, z, -1);
}

/// The innermost level has been left: relocates in its mother.
[[gnu::always_inline]] inline void leave_level(NavigationStack* stack, const Context* context,
                                               double x, double y, double z) {
  const unsigned left = stack->levels[stack->depth].daughter;
  if (--stack->depth < 0) return;
  relocate_in_table(stack, context, stack->levels[stack->depth].volume, x, y, z,
                    static_cast<int>(left));
}

/// The step, with the kernels' short ways (`rare` false), which are for rays along no face and take
/// no start within a daughter, or with all that they can do. Nothing has changed where the result
/// is negative.
template <bool rare, class S>
[[gnu::always_inline]] inline double try_step_in(const S& s, NavigationStack* stack,
                                                 const Context* context, const Vec3<double>& p,
                                                 const Direction<double>& v, double x, double y,
                                                 double z, double limit) {
  using Daughters = decltype(s.daughters);
  double best = rare ? distance_to_out(s.mother, p, v, s.tolerance)
                     : distance_to_exit(s.mother, p, v, s.tolerance);
  [[maybe_unused]] int hit = -1;
  if constexpr (Daughters::any) {
    const unsigned left = stack->levels[stack->depth + 1].daughter;
    if constexpr (rare) {
      hit = s.search.nearest(s.daughters, p, v, best, limit, left, s.tolerance);
    } else {
      const MostlyAhead<Daughters> ahead{s.daughters, s.daughters.count};
      hit = s.search.nearest(ahead, p, v, best, limit, left, s.tolerance);
    }
  }
  if (__builtin_expect(!(best > 0), 0)) return -1.0;
  if (best > limit) {
    stack->boundary = 0;
    return limit;
  }
  stack->boundary = 1;
  x += best * stack->ray.given[0];
  y += best * stack->ray.given[1];
  z += best * stack->ray.given[2];
  if constexpr (Daughters::any) {
    if (hit >= 0) {
      const auto k = static_cast<unsigned>(hit);
      s.daughters.template push<typename S::frame_type>(stack, k);
      descend_into(s, stack, context, k, x, y, z);
      return best;
    }
  }
  leave_level(stack, context, x, y, z);
  return best;
}

/// Out of line, so that it takes no registers from the common step.
template <class S>
[[gnu::noinline, gnu::flatten]] double step_with_all_cases(const S& s, NavigationStack* stack,
                                                           const Context* context, double x,
                                                           double y, double z, double limit) {
  const StackLevel& level = stack->levels[stack->depth];
  const Vec3<double> p = s.frame.point(level, x, y, z);
  const Direction<double>& v = s.frame.ray(stack, level);
  return try_step_in<true>(s, stack, context, p, v, x, y, z, limit);
}

template <class S>
[[gnu::always_inline]] inline double step_in(const S& s, NavigationStack* stack,
                                             const Context* context, double x, double y, double z,
                                             double limit) {
  const StackLevel& level = stack->levels[stack->depth];
  const Vec3<double> p = s.frame.point(level, x, y, z);
  const Direction<double>& v = s.frame.ray(stack, level);
  if (__builtin_expect(s.frame.oblique(stack, level, v), 1)) {
    const double length = try_step_in<false>(s, stack, context, p, v, x, y, z, limit);
    if (__builtin_expect(length >= 0, 1)) return length;
  }
  return step_with_all_cases(s, stack, context, x, y, z, limit);
}

template <class S>
[[gnu::always_inline]] inline void relocate_in(const S& s, NavigationStack* stack,
                                               const Context* context, double x, double y, double z,
                                               int blocked) {
  using Daughters = decltype(s.daughters);
  if constexpr (Daughters::any) {
    const StackLevel& level = stack->levels[stack->depth];
    const Vec3<double> p = s.frame.point(level, x, y, z);
    const Direction<double>& v = s.frame.heading(stack, level);
    int found = -1;
    if (blocked < 0) {
      found = s.search.find(s.daughters, p, v, -1, s.tolerance);
    } else {
      const CompactNeighbourList* list = s.lists == nullptr ? nullptr : s.lists + blocked;
      const bool there = list != nullptr && is_there(*list, p);
      if (!(there && list->mother_contains) && !contains(s.mother, p, v, s.tolerance)) {
        leave_level(stack, context, x, y, z);
        return;
      }
      if (there && list->count != CompactNeighbourList::unlisted) {
        for (unsigned m = list->first; m != list->first + list->count; ++m) {
          if (s.daughters.holds(s.neighbours[m], p, v, s.tolerance)) {
            found = static_cast<int>(s.neighbours[m]);
            break;
          }
        }
      } else {
        found = s.search.find(s.daughters, p, v, blocked, s.tolerance);
      }
    }
    if (found < 0) return;
    const auto k = static_cast<unsigned>(found);
    s.daughters.template push<typename S::frame_type>(stack, k);
    descend_into(s, stack, context, k, x, y, z);
  }
}

template <class S>
[[gnu::always_inline]] inline double safety_in(const S& s, const NavigationStack* stack, double x,
                                               double y, double z) {
  using Daughters = decltype(s.daughters);
  const Vec3<double> p = s.frame.point(stack->levels[stack->depth], x, y, z);
  double safety = safety_to_out(s.mother, p);
  if constexpr (Daughters::any) {
    if constexpr (requires { s.search.safety_among(s.daughters, p, safety); }) {
      safety = s.search.safety_among(s.daughters, p, safety);
    } else if (s.boxes.blocks != nullptr) {
      safety =
          safety_near_boxes(s.boxes, p, safety, [&](unsigned k) { return s.daughters.away(k, p); });
    } else {
      for (unsigned k = 0; k < s.daughters.count; ++k) {
        safety = smaller(larger(s.daughters.away(k, p), 0.0), safety);
      }
    }
  }
  return larger(safety - s.tolerance, 0.0);
}

}  // namespace navjit::kernels
