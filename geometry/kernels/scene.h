// How a scene is navigated: the one template of all navigators that are not generic. Its parts are
// types (frame, mother's solid, daughters, search), its numbers are data: a struct in memory, or
// constants that fold. Gives the bits of the generic navigator, and leaves to it (a negative
// result) only what `Rare` says. Steps of length zero are relocated by functions of the context's,
// with more care than pays here.
namespace navjit::kernels {

/// What becomes of steps that are rare: from within a daughter, along faces.
enum class Rare {
  out_of_line,  ///< made by code apart from the common step's
  left_out,     ///< left to the generic navigator: much less code
  taken,        ///< made by the one code there is, which takes every step
};

/// Whether a search may ask the daughter that was left last, for nothing: those that ask all at
/// once, or go on from it, do not.
template <class Search>
constexpr bool asks_what_was_left = true;
template <class Fours>
constexpr bool asks_what_was_left<SearchLanes<Fours>> = false;
template <class Index>
constexpr bool asks_what_was_left<SearchSlabs<Index>> = false;
template <const auto& known>
constexpr bool asks_what_was_left<ConstantSearch<known>> =
    asks_what_was_left<decltype(ConstantSearch<known>::tables)>;

/// Whether a table is there.
enum class Has { maybe, yes, no };

struct LeaveByStack;
struct EnterByTable;

/// The static members are what is assumed where no more is known; scenes of which more is known are
/// derived from this, with members of their own of the same names.
template <class Frame, class Mother, class Daughters, class Search, class Tolerance = double>
struct Scene {
  using frame_type = Frame;
  using leave = LeaveByStack;
  using enter = EnterByTable;
  static constexpr Rare rare = Rare::out_of_line;
  static constexpr bool oblique_only = true;  ///< rays along planes of the frame's axes are rare
  static constexpr Has has_lists = Has::maybe, has_boxes = Has::maybe;
  static constexpr bool shared_moves = false;  ///< relocation is called by others, too
  /// A daughter's record may name a stand-in: the first of the volumes that share its scene's code.
  /// The context knows which volume the daughter is.
  static constexpr bool stand_ins = false;
  static constexpr unsigned long at = 0;  ///< its place in the data of all that it calls

  [[no_unique_address]] Tolerance tolerance;
  [[no_unique_address]] Frame frame;
  [[no_unique_address]] Mother mother;
  [[no_unique_address]] Daughters daughters;
  [[no_unique_address]] Search search;
  const NeighbourList* lists;  ///< by daughter; null: not used
  const unsigned* neighbours;  ///< of daughters, as `lists` counts them
  const BoxBlock* beside;      ///< the boxes of neighbours, likewise
  NearBoxes boxes;             ///< of daughters, for safety; without blocks every one is asked
};

template <class S>
[[gnu::always_inline]] inline const S& scene_in(const void* data) {
  return *reinterpret_cast<const S*>(static_cast<const char*>(data) + S::at);
}

template <class S>
[[gnu::always_inline]] inline void go_down(const void* data, NavigationStack* stack,
                                           const Context* context, double x, double y, double z);
template <class S>
[[gnu::always_inline]] inline void go_up(const void* data, NavigationStack* stack,
                                         const Context* context, double x, double y, double z,
                                         unsigned blocked);
/// The same for several callers.
template <class S>
[[gnu::noinline]] void enter_scene(const void* data, NavigationStack* stack, const Context* context,
                                   double x, double y, double z) {
  go_down<S>(data, stack, context, x, y, z);
}
template <class S>
[[gnu::noinline]] void reenter_scene(const void* data, NavigationStack* stack,
                                     const Context* context, double x, double y, double z,
                                     unsigned blocked) {
  go_up<S>(data, stack, context, x, y, z, blocked);
}

// The innermost level, daughter `left`, has been left: how to relocate in its mother.

/// Whatever the mother is.
struct LeaveByStack {
  [[gnu::always_inline]] static void go(const void*, NavigationStack* stack, const Context* context,
                                        double x, double y, double z, unsigned left) {
    if (--stack->depth < 0) return;
    relocate_in_table(stack, context, stack->levels[stack->depth].volume, x, y, z,
                      static_cast<int>(left));
  }
};
/// It is the world that was left.
struct LeaveWorld {
  [[gnu::always_inline]] static void go(const void*, NavigationStack* stack, const Context*, double,
                                        double, double, unsigned) {
    --stack->depth;
  }
};
/// All placements are in one volume.
template <unsigned mother>
struct LeaveToVolume {
  [[gnu::always_inline]] static void go(const void*, NavigationStack* stack, const Context* context,
                                        double x, double y, double z, unsigned left) {
    --stack->depth;
    relocate_in_table(stack, context, mother, x, y, z, static_cast<int>(left));
  }
};
/// And its scene's code is beside this.
template <class S>
struct LeaveToScene {
  [[gnu::always_inline]] static void go(const void* data, NavigationStack* stack,
                                        const Context* context, double x, double y, double z,
                                        unsigned left) {
    --stack->depth;
    reenter_scene<S>(data, stack, context, x, y, z, left);
  }
};

// Daughter `d`, which is `volume`, was just entered: how to relocate in it. `by_step`: through its
// surface. `d` itself may name a stand-in.

/// Whether nothing of the daughter's own can be where it was entered.
template <class Daughter>
[[gnu::always_inline]] inline bool enters_nothing(const Daughter& d, bool by_step) {
  return by_step ? d.inner != has_surface_daughters : d.inner == no_daughters;
}

struct EnterByTable {
  template <class Daughter>
  [[gnu::always_inline]] static void go(const void*, NavigationStack* stack, const Context* context,
                                        const Daughter& d, unsigned volume, double x, double y,
                                        double z, bool by_step) {
    if (!enters_nothing(d, by_step)) relocate_in_table(stack, context, volume, x, y, z, -1);
  }
};
/// No daughter has daughters.
struct EnterLeaves {
  template <class Daughter>
  [[gnu::always_inline]] static void go(const void*, NavigationStack*, const Context*,
                                        const Daughter&, unsigned, double, double, double, bool) {}
};
template <unsigned number, class S>
struct VolumeOfScene {
  static constexpr unsigned volume = number;
  using scene = S;
};
/// Some volumes' scenes have their code beside this; `all`: of those that have daughters.
template <bool leaves, bool all, class First, class... Others>
struct EnterScenes {
  template <class Daughter>
  [[gnu::always_inline]] static void go(const void* data, NavigationStack* stack,
                                        const Context* context, const Daughter& d, unsigned volume,
                                        double x, double y, double z, bool by_step) {
    if ((leaves || by_step) && enters_nothing(d, by_step)) return;
    if ((all && sizeof...(Others) == 0) || d.volume == First::volume) {
      enter_scene<typename First::scene>(data, stack, context, x, y, z);
    } else if constexpr (sizeof...(Others) > 0) {
      EnterScenes<false, all, Others...>::go(data, stack, context, d, volume, x, y, z, false);
    } else {
      relocate_in_table(stack, context, volume, x, y, z, -1);
    }
  }
};

template <class S>
[[gnu::always_inline]] inline bool has_neighbour_lists(const S& s) {
  return S::has_lists == Has::yes || (S::has_lists == Has::maybe && s.lists != nullptr);
}

template <class S>
[[gnu::always_inline]] inline void enter_daughter(const void* data, const S& s,
                                                  NavigationStack* stack, const Context* context,
                                                  unsigned k, double x, double y, double z,
                                                  bool by_step = false) {
  // For when the track leaves it again: lists of thousands of daughters are far away.
  if (has_neighbour_lists(s)) __builtin_prefetch(s.lists + k);
  s.daughters.template push<typename S::frame_type>(stack, k);
  unsigned volume = s.daughters.at[k].volume;
  if constexpr (S::stand_ins) {
    volume = context->daughters[stack->levels[stack->depth - 1].volume][k];
    stack->levels[stack->depth].volume = volume;
  }
  S::enter::go(data, stack, context, s.daughters.at[k], volume, x, y, z, by_step);
}

/// The step. `rare`: with all that the kernels can do; else in their short ways, which take no
/// start within a daughter. Nothing has changed where the result is negative.
template <bool rare, class S>
[[gnu::always_inline]] inline double try_step_in(const void* data, NavigationStack* stack,
                                                 const Context* context, const Vec3<double>& p,
                                                 const Direction<double>& v, double x, double y,
                                                 double z, double limit) {
  const S& s = scene_in<S>(data);
  using Daughters = decltype(s.daughters);
  const double tol = s.tolerance;
  double best = rare ? distance_to_out(s.mother, p, v, tol) : distance_to_exit(s.mother, p, v, tol);
  if (__builtin_expect(best == 0, 0)) {
    // No daughter is nearer. Photons that are reflected come here often.
    context->leave_at_once(stack, context, x, y, z);
    return best;
  }
  [[maybe_unused]] int hit = -1;
  if constexpr (Daughters::any) {
    const unsigned left = stack->levels[stack->depth + 1].daughter;
    if constexpr (rare) {
      hit = s.search.nearest(s.daughters, p, v, best, limit, left, tol);
    } else {
      unsigned for_good = LeftForGood::none;
      if constexpr (asks_what_was_left<decltype(s.search)>) {
        for_good = left_for_good(*stack, x, y, z, tol);
      }
      MostlyAhead<Daughters, S::oblique_only> ahead{s.daughters, s.daughters.count, for_good,
                                                    nullptr, 0};
      if constexpr (requires { decltype(s.search)::remembers_boxes; }) {
        if (stack->boxes_ahead != nullptr) {
          ahead.boxes_ahead = stack->boxes_ahead + stack->depth % 2;
        }
        ahead.mother = stack->levels[stack->depth].touchable;
      }
      hit = s.search.nearest(ahead, p, v, best, limit, left, tol);
    }
  }
  if (__builtin_expect(!(best > 0), 0)) {
    // Into a daughter at whose surface the track is already, or from within one.
    return Daughters::any ? context->return_at_once(stack, context, x, y, z) : -1.0;
  }
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
      enter_daughter(data, s, stack, context, static_cast<unsigned>(hit), x, y, z, true);
      return best;
    }
  }
  stack->left.from = stack->depth;
  S::leave::go(data, stack, context, x, y, z, stack->levels[stack->depth].daughter);
  return best;
}

/// Out of line, so that it takes no registers from the common step.
template <class S>
[[gnu::noinline, gnu::flatten]] double step_with_all_cases(const void* data, NavigationStack* stack,
                                                           const Context* context, double x,
                                                           double y, double z, double limit) {
  const S& s = scene_in<S>(data);
  const StackLevel& level = stack->levels[stack->depth];
  const Vec3<double> p = s.frame.point(level, x, y, z);
  const Direction<double>& v = s.frame.ray(stack, level);
  return try_step_in<true, S>(data, stack, context, p, v, x, y, z, limit);
}

template <class S>
[[gnu::always_inline]] inline double step_in(const void* data, NavigationStack* stack,
                                             const Context* context, double x, double y, double z,
                                             double limit) {
  const S& s = scene_in<S>(data);
  const StackLevel& level = stack->levels[stack->depth];
  const Vec3<double> p = s.frame.point(level, x, y, z);
  const Direction<double>& v = s.frame.ray(stack, level);
  if constexpr (S::rare == Rare::taken) {
    return try_step_in<true, S>(data, stack, context, p, v, x, y, z, limit);
  } else {
    double length = -1;
    if (!S::oblique_only || __builtin_expect(s.frame.oblique(stack, level, v), 1)) {
      length = try_step_in<false, S>(data, stack, context, p, v, x, y, z, limit);
      if (__builtin_expect(length >= 0, 1)) return length;
    }
    if constexpr (S::rare == Rare::out_of_line) {
      return step_with_all_cases<S>(data, stack, context, x, y, z, limit);
    }
    return length;
  }
}

template <class S>
[[gnu::always_inline]] inline void go_down(const void* data, NavigationStack* stack,
                                           const Context* context, double x, double y, double z) {
  const S& s = scene_in<S>(data);
  const StackLevel& level = stack->levels[stack->depth];
  const int k = s.search.find(s.daughters, s.frame.point(level, x, y, z),
                              s.frame.heading(stack, level), -1, s.tolerance);
  if (k >= 0) enter_daughter(data, s, stack, context, static_cast<unsigned>(k), x, y, z);
}

/// The daughter, other than `blocked`, that holds a point where `blocked` was left; -1 for none.
template <class S>
[[gnu::always_inline]] inline int find_beside(const S& s, const NeighbourList& list, bool there,
                                              const Vec3<double>& p, const Direction<double>& v,
                                              unsigned blocked) {
  const double tol = s.tolerance;
  if (__builtin_expect(!there || list.count == NeighbourList::unlisted, 0)) {
    return find_seldom(s.search, s.daughters, p.x, p.y, p.z, v.x, v.y, v.z,
                       static_cast<int>(blocked), tol);
  }
  if (list.block != NeighbourList::no_block) {
    return first_around(s.beside + list.block, s.neighbours + list.first, list.count, p,
                        [&](unsigned k) { return s.daughters.holds(k, p, v, tol); });
  }
  for (unsigned m = list.first; m != list.first + list.count; ++m) {
    if (s.daughters.holds(s.neighbours[m], p, v, tol)) return static_cast<int>(s.neighbours[m]);
  }
  return -1;
}

template <class S>
[[gnu::always_inline]] inline void go_up(const void* data, NavigationStack* stack,
                                         const Context* context, double x, double y, double z,
                                         unsigned blocked) {
  const S& s = scene_in<S>(data);
  const StackLevel& level = stack->levels[stack->depth];
  const Vec3<double> p = s.frame.point(level, x, y, z);
  const Direction<double>& v = s.frame.heading(stack, level);
  const double tol = s.tolerance;
  const bool listed = has_neighbour_lists(s);
  const bool there = listed && is_there(s.lists[blocked], p);
  if (!(there && s.lists[blocked].mother_contains) && !contains(s.mother, p, v, tol)) {
    S::leave::go(data, stack, context, x, y, z, level.daughter);
    return;
  }
  const int k = listed ? find_beside(s, s.lists[blocked], there, p, v, blocked)
                       : s.search.find(s.daughters, p, v, static_cast<int>(blocked), tol);
  if (k >= 0) {
    enter_daughter(data, s, stack, context, static_cast<unsigned>(k), x, y, z);
    return;
  }
  if constexpr (asks_what_was_left<decltype(s.search)>) {
    // A level between may have ended elsewhere: what was in it reached beyond.
    if (stack->left.from == stack->depth + 1 &&
        (s.daughters.leaves_for_good(blocked, p, tol) ||
         (there && comes_out_of_box(s.lists[blocked], p, v, tol)))) {
      stack->left = {{x, y, z}, level.touchable, blocked, -1};
    }
  }
}

template <class S>
[[gnu::always_inline]] inline void relocate_in(const void* data, NavigationStack* stack,
                                               const Context* context, double x, double y, double z,
                                               int blocked) {
  if constexpr (decltype(S::daughters)::any) {
    const auto daughter = static_cast<unsigned>(blocked);
    if constexpr (S::shared_moves) {
      if (blocked < 0) {
        enter_scene<S>(data, stack, context, x, y, z);
      } else {
        reenter_scene<S>(data, stack, context, x, y, z, daughter);
      }
    } else {
      if (blocked < 0) {
        go_down<S>(data, stack, context, x, y, z);
      } else {
        go_up<S>(data, stack, context, x, y, z, daughter);
      }
    }
  }
}

/// Folds daughters from `k` on into a safety.
template <unsigned k, class Daughters>
[[gnu::always_inline]] inline double safety_to_listed(const Vec3<double>& p, double safety) {
  if constexpr (k < Daughters::listed) {
    safety = smaller(larger(Daughters::template away_one<k>(p), 0.0), safety);
    return safety_to_listed<k + 1, Daughters>(p, safety);
  } else {
    return safety;
  }
}

template <class S>
[[gnu::always_inline]] inline double safety_in(const void* data, const NavigationStack* stack,
                                               double x, double y, double z, double enough) {
  const S& s = scene_in<S>(data);
  using Daughters = decltype(s.daughters);
  const Vec3<double> p = s.frame.point(stack->levels[stack->depth], x, y, z);
  double safety = smaller(safety_to_out(s.mother, p), enough + 2 * s.tolerance);
  if constexpr (Daughters::any) {
    if constexpr (requires { s.search.safety_among(s.daughters, p, safety); }) {
      safety = s.search.safety_among(s.daughters, p, safety);
    } else if (S::has_boxes == Has::yes ||
               (S::has_boxes == Has::maybe && s.boxes.blocks != nullptr)) {
      safety =
          safety_near_boxes(s.boxes, p, safety, [&](unsigned k) { return s.daughters.away(k, p); });
    } else if constexpr (Daughters::listed > 0) {
      safety = safety_to_listed<0, Daughters>(p, safety);
    } else {
      for (unsigned k = 0; k < s.daughters.count; ++k) {
        safety = smaller(larger(s.daughters.away(k, p), 0.0), safety);
      }
    }
  }
  return smaller(larger(safety - s.tolerance, 0.0), enough);
}

}  // namespace navjit::kernels
