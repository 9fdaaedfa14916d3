// How a scene is navigated: the one template of all navigators except the generic one. The parts of
// a scene are types (frame, mother's solid, daughters, search). Its numbers are data: a struct in
// memory, or constants that are folded into the code. A navigator gives the same bits as the
// generic one, and leaves to it (by a negative result) only the steps that `Rare` names. Steps of
// length zero are relocated by functions of the context, with more care than would pay here.
namespace navjit::kernels {

/// What becomes of steps that are rare: those from within a daughter, and those along faces.
enum class Rare {
  out_of_line,  ///< made by code apart from that of the common step
  left_out,     ///< left to the generic navigator, which saves much code
  taken,        ///< made by the same code as all other steps
};

/// Whether a search may ask the daughter that was left last although the ray cannot meet it.
/// Searches that ask all at once, or that go on from this daughter, do not.
template <class Search>
constexpr bool asks_what_was_left = true;
template <class Fours>
constexpr bool asks_what_was_left<SearchLanes<Fours>> = false;
template <class Index>
constexpr bool asks_what_was_left<SearchSlabs<Index>> = false;
template <const auto& known>
constexpr bool asks_what_was_left<ConstantSearch<known>> =
    asks_what_was_left<decltype(ConstantSearch<known>::tables)>;

/// Whether a scene has a table. `maybe`: that is known only at run time.
enum class Has { maybe, yes, no };

struct LeaveByStack;
struct EnterByTable;

/// The parts of a scene. The static members are what holds if no more is known. A scene of which
/// more is known has a type derived from this one, with members of its own of the same names.
template <class Frame, class Mother, class Daughters, class Search, class Tolerance = double>
struct Scene {
  using frame_type = Frame;
  using leave = LeaveByStack;
  using enter = EnterByTable;
  static constexpr Rare rare = Rare::out_of_line;
  static constexpr bool oblique_only = true;  ///< rays along planes of the frame's axes are rare
  static constexpr Has has_lists = Has::maybe, has_boxes = Has::maybe;
  static constexpr bool shared_moves = false;  ///< others call this relocation, too
  /// A daughter's record may name a stand-in: the first of the volumes that share its scene's code.
  /// The context knows which volume the daughter is.
  static constexpr bool stand_ins = false;
  static constexpr unsigned long at = 0;  ///< where it is in the data of all that it calls, bytes

  [[no_unique_address]] Tolerance tolerance;
  [[no_unique_address]] Frame frame;
  [[no_unique_address]] Mother mother;
  [[no_unique_address]] Daughters daughters;
  [[no_unique_address]] Search search;
  const NeighbourList* lists;  ///< by daughter; null: not used
  const unsigned* neighbours;  ///< of all daughters, one list after the other
  const BoxBlock* beside;      ///< the boxes of neighbours, one list after the other
  NearBoxes boxes;  ///< of daughters, for safety; if there are none, every daughter is asked
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
/// The same as functions that several callers share.
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

// The next types say how to relocate in the mother after the innermost level, its daughter `left`,
// has been left.

/// The mother may be any volume.
struct LeaveByStack {
  [[gnu::always_inline]] static void go(const void*, NavigationStack* stack, const Context* context,
                                        double x, double y, double z, unsigned left) {
    if (--stack->depth < 0) return;
    relocate_in_table(stack, context, stack->levels[stack->depth].volume, x, y, z,
                      static_cast<int>(left));
  }
};
/// The world was left.
struct LeaveWorld {
  [[gnu::always_inline]] static void go(const void*, NavigationStack* stack, const Context*, double,
                                        double, double, unsigned) {
    --stack->depth;
  }
};
/// All placements of the volume are in one mother.
template <unsigned mother>
struct LeaveToVolume {
  [[gnu::always_inline]] static void go(const void*, NavigationStack* stack, const Context* context,
                                        double x, double y, double z, unsigned left) {
    --stack->depth;
    relocate_in_table(stack, context, mother, x, y, z, static_cast<int>(left));
  }
};
/// All placements are in one mother, and the code of the mother's scene is in the same module.
template <class S>
struct LeaveToScene {
  [[gnu::always_inline]] static void go(const void* data, NavigationStack* stack,
                                        const Context* context, double x, double y, double z,
                                        unsigned left) {
    --stack->depth;
    reenter_scene<S>(data, stack, context, x, y, z, left);
  }
};

// The next types say how to relocate in the daughter `d` after it was entered. Its volume is
// `volume`; `d.volume` may be that of a stand-in. `by_step`: it was entered through its surface.

/// Whether none of the daughter's own daughters can be at the point where it was entered.
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
/// No daughter has daughters of its own.
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
/// The scenes of some volumes have their code in the same module; `all`: so have all volumes that
/// have daughters. `leaves`: some volumes have no daughters.
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
  // The list is needed when the track leaves the daughter again. If there are thousands, most lists
  // are not in the cache.
  if (has_neighbour_lists(s)) __builtin_prefetch(s.lists + k);
  s.daughters.template push<typename S::frame_type>(stack, k);
  unsigned volume = s.daughters.at[k].volume;
  if constexpr (S::stand_ins) {
    volume = context->daughters[stack->levels[stack->depth - 1].volume][k];
    stack->levels[stack->depth].volume = volume;
  }
  S::enter::go(data, stack, context, s.daughters.at[k], volume, x, y, z, by_step);
}

/// Makes a step. `rare`: with all that the kernels can do. Otherwise by their short ways, which do
/// not accept a start within a daughter. If the result is negative, nothing has changed.
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
    // The ray enters a daughter at whose surface it is already, or it starts within a daughter.
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

/// A step in any case. It is out of line, so that it takes no registers from the common step.
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

/// The daughter, other than `blocked`, that holds a point at which `blocked` was left; -1 for none.
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
    // Only if the last step ended at the surface of `blocked` itself. If it ended at that of a
    // deeper level, which may reach beyond `blocked` in an invalid geometry, it is not known where
    // `blocked` ends.
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

/// The smallest of `safety` and the safeties of the daughters from `k` on.
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
