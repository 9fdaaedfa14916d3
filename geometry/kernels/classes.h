// Daughters in classes. The daughters of a class have one solid, or solids of one kind, and are
// tested by the same code, in which the numbers that all of them share are constants. There are
// fewer classes than kinds of solids, which makes a short switch; if there is only one class, there
// is no switch.
namespace navjit::kernels {

/// A daughter that is placed in any way.
struct PlacedDaughter {
  double x, y, z;          ///< translation in the mother's frame, mm
  const double* rotation;  ///< null: none
  const void* shape;       ///< of the kind of its class; not used if the class has one solid
  unsigned long long offset;
  unsigned volume;
  unsigned short kind;  ///< number of its class
  InnerDaughters inner;
};
/// The same for scenes with a class of boxes, whose half lengths are kept beside the places.
struct PlacedBoxDaughter : PlacedDaughter {
  Box<double> box;
};

/// The tables of a scene's daughters.
template <class Daughter>
struct DaughterTable {
  const Daughter* at;
  const Vec3<double> (*boxes)[2];  ///< by daughter: corners of the solid's box, with a margin
};

// The next types say where the solid of a class is.

/// All daughters of the class have the same solid.
template <const auto& solid>
struct SameSolid {
  template <class Daughter>
  static ConstantSolid<solid> of(const Daughter&) {
    return {};
  }
};
/// Each daughter has a solid of its own, all of one kind.
template <class Shape>
struct OwnSolid {
  template <class Daughter>
  static KnownSolid<Shape> of(const Daughter& d) {
    return {static_cast<const Shape*>(d.shape)};
  }
};
/// The half lengths of boxes, by axis: whether all boxes share one, and which it is, mm.
struct BoxConstants {
  bool same[3];
  double half[3];
};
/// Each daughter has a box of its own, except for the half lengths that all share.
template <const auto& shared>
struct OwnBox {
  template <class Daughter>
  static Box<double> of(const Daughter& d) {
    return {shared.same[0] ? shared.half[0] : d.box.hx, shared.same[1] ? shared.half[1] : d.box.hy,
            shared.same[2] ? shared.half[2] : d.box.hz};
  }
};

/// The solid that `Solid` gives, with kernels that are not inlined.
template <class Solid>
struct Apart {
  template <class Daughter>
  static auto of(const Daughter& d) {
    return SolidApart<decltype(Solid::of(d))>{Solid::of(d)};
  }
};

// The next types say where the box is that is tested before the solid of a class.

struct NoBox {
  static constexpr bool any = false;
};
template <const auto& box>
struct SameBounds {
  static constexpr bool any = true;
  static const Vec3<double>& corner(const Vec3<double> (*)[2], unsigned, int i) { return box[i]; }
};
struct OwnBounds {
  static constexpr bool any = true;
  static const Vec3<double>& corner(const Vec3<double> (*boxes)[2], unsigned k, int i) {
    return boxes[k][i];
  }
};

template <class Solid, const auto& place, class Bounds>
struct DaughterClass {
  static constexpr bool rotated = place.rotated;

  static Vec3<double> turned(const double* r, double x, double y, double z) {
    if constexpr (place.same_turn) {
      return turned_by<place>(x, y, z);
    } else {
      return {r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z,
              r[6] * x + r[7] * y + r[8] * z};
    }
  }
  template <class Daughter>
  static Vec3<double> local(const Daughter& d, const Vec3<double>& p) {
    const double x = p.x - coordinate<place, 0>(d.x), y = p.y - coordinate<place, 1>(d.y),
                 z = p.z - coordinate<place, 2>(d.z);
    if constexpr (rotated) {
      return turned(d.rotation, x, y, z);
    } else {
      return {x, y, z};
    }
  }
  template <class Daughter>
  static bool holds(const DaughterTable<Daughter>& table, const Daughter& d, unsigned k,
                    const Vec3<double>& p, const Direction<double>& v, double tol) {
    const Vec3<double> q = local(d, p);
    if constexpr (Bounds::any) {
      if (!is_in_box(Bounds::corner(table.boxes, k, 0), Bounds::corner(table.boxes, k, 1), q)) {
        return false;
      }
    }
    if constexpr (rotated) {
      const Vec3<double> u = turned(d.rotation, v.x, v.y, v.z);
      return contains(Solid::of(d), q, make_heading<double>(u.x, u.y, u.z), tol);
    } else {
      return contains(Solid::of(d), q, v, tol);
    }
  }
  /// `entry`: calls distance_to_entry, unless this needs an oblique ray and the daughter is
  /// rotated.
  template <bool entry, class Daughter>
  static double distance(const DaughterTable<Daughter>& table, const Daughter& d, unsigned k,
                         const Vec3<double>& p, const Direction<double>& v, double reach,
                         double tol) {
    if constexpr (rotated) {
      const Vec3<double> u = turned(d.rotation, v.x, v.y, v.z);
      constexpr bool by_entry = entry && !entry_needs_oblique<decltype(Solid::of(d))>;
      return to_solid<by_entry>(table, d, k, local(d, p), make_direction<double>(u.x, u.y, u.z),
                                reach, tol);
    } else {
      return to_solid<entry>(table, d, k, local(d, p), v, reach, tol);
    }
  }
  template <bool entry, class Daughter>
  static double to_solid(const DaughterTable<Daughter>& table, const Daughter& d, unsigned k,
                         const Vec3<double>& q, const Direction<double>& e, double reach,
                         double tol) {
    if constexpr (Bounds::any) {
      if (!may_meet_box(Bounds::corner(table.boxes, k, 0), Bounds::corner(table.boxes, k, 1), q, e,
                        reach)) {
        return infinity<double>();
      }
    }
    if constexpr (entry) {
      return distance_to_entry(Solid::of(d), q, e, tol);
    } else {
      return distance_to_in(Solid::of(d), q, e, tol);
    }
  }
  template <class Daughter>
  static bool leaves_for_good(const Daughter& d, const Vec3<double>& p, double tol) {
    return is_left_for_good(Solid::of(d), local(d, p), tol);
  }
  template <class Daughter>
  static double away(const Daughter& d, const Vec3<double>& p) {
    return safety_to_in(Solid::of(d), local(d, p));
  }
};

/// Calls ask(c), where c is the class with this number.
template <class First, class... Others, class Ask>
auto ask_class(unsigned kind, const Ask& ask) {
  if constexpr (sizeof...(Others) == 0) {
    return ask(First{});
  } else {
    if (kind == 0) return ask(First{});
    return ask_class<Others...>(kind - 1, ask);
  }
}

/// Pushes daughter `k`. `shared` is the PlaceConstants of all daughters.
template <class Frame, const auto& shared, bool any_rotated, bool all_rotated, class Daughter>
void push_of_class(NavigationStack* stack, const Daughter& d, unsigned k) {
  if constexpr (any_rotated) {
    if (all_rotated || d.rotation != nullptr) {
      if (!Frame::rotated && stack->levels[stack->depth].rotation != nullptr) {
        __builtin_unreachable();
      }
      push_rotated(stack, d.volume, k, d.offset, d.x, d.y, d.z, d.rotation);
      return;
    }
  }
  push_placed<Frame, shared>(stack, d.volume, k, d.offset, d.x, d.y, d.z);
}

/// Daughters in a table.
template <class Daughter, const auto& shared, class... Classes>
struct ClassedDaughters : DaughterTable<Daughter> {
  static constexpr bool any = true;
  static constexpr unsigned listed = 0;
  static constexpr bool any_rotated = (Classes::rotated || ...),
                        all_rotated = (Classes::rotated && ...);
  unsigned count;

  /// Prefetches the record of a daughter that will be asked.
  [[gnu::always_inline]] void fetch(unsigned k) const { __builtin_prefetch(this->at + k); }

  bool holds(unsigned k, const Vec3<double>& p, const Direction<double>& v, double tol) const {
    const Daughter& d = this->at[k];
    return ask_class<Classes...>(
        d.kind, [&](auto c) { return decltype(c)::holds(*this, d, k, p, v, tol); });
  }
  template <bool entry>
  double path_to(unsigned k, const Vec3<double>& p, const Direction<double>& v, double reach,
                 double tol) const {
    const Daughter& d = this->at[k];
    return ask_class<Classes...>(d.kind, [&](auto c) {
      return decltype(c)::template distance<entry>(*this, d, k, p, v, reach, tol);
    });
  }
  double distance(unsigned k, const Vec3<double>& p, const Direction<double>& v, double reach,
                  double tol) const {
    return path_to<false>(k, p, v, reach, tol);
  }
  double entry(unsigned k, const Vec3<double>& p, const Direction<double>& v, double reach,
               double tol) const {
    return path_to<true>(k, p, v, reach, tol);
  }
  bool leaves_for_good(unsigned k, const Vec3<double>& p, double tol) const {
    const Daughter& d = this->at[k];
    return ask_class<Classes...>(d.kind,
                                 [&](auto c) { return decltype(c)::leaves_for_good(d, p, tol); });
  }
  double away(unsigned k, const Vec3<double>& p) const {
    const Daughter& d = this->at[k];
    return ask_class<Classes...>(d.kind, [&](auto c) { return decltype(c)::away(d, p); });
  }
  template <class Frame>
  void push(NavigationStack* stack, unsigned k) const {
    push_of_class<Frame, shared, any_rotated, all_rotated>(stack, this->at[k], k);
  }
};

/// The n-th of some types.
template <unsigned n, class First, class... Others>
struct NthOf : NthOf<n - 1, Others...> {};
template <class First, class... Others>
struct NthOf<0, First, Others...> {
  using type = First;
};

/// A few daughters, each of which is a class of its own. All their numbers are constants.
template <const auto& places, const auto& shared, class... Classes>
struct ListedDaughters {
  static constexpr bool any = true;
  static constexpr unsigned listed = sizeof...(Classes);  ///< how many are types of their own
  static constexpr bool any_rotated = (Classes::rotated || ...),
                        all_rotated = (Classes::rotated && ...);
  static constexpr unsigned count = sizeof...(Classes);
  static constexpr const PlacedDaughter* at = places;
  static constexpr DaughterTable<PlacedDaughter> table{places, nullptr};
  template <unsigned k>
  using Nth = typename NthOf<k, Classes...>::type;

  template <unsigned k>
  static bool holds_one(const Vec3<double>& p, const Direction<double>& v, double tol) {
    return Nth<k>::holds(table, places[k], k, p, v, tol);
  }
  template <unsigned k, bool entry>
  static double path_to_one(const Vec3<double>& p, const Direction<double>& v, double reach,
                            double tol) {
    return Nth<k>::template distance<entry>(table, places[k], k, p, v, reach, tol);
  }
  template <unsigned k>
  static double distance_one(const Vec3<double>& p, const Direction<double>& v, double reach,
                             double tol) {
    return path_to_one<k, false>(p, v, reach, tol);
  }
  template <unsigned k>
  static double away_one(const Vec3<double>& p) {
    return Nth<k>::away(places[k], p);
  }
  // The same by a number that is not a constant, for rare cases.
  static bool holds(unsigned k, const Vec3<double>& p, const Direction<double>& v, double tol) {
    return ask_class<Classes...>(
        k, [&](auto c) { return decltype(c)::holds(table, places[k], k, p, v, tol); });
  }
  static bool leaves_for_good(unsigned k, const Vec3<double>& p, double tol) {
    return ask_class<Classes...>(
        k, [&](auto c) { return decltype(c)::leaves_for_good(places[k], p, tol); });
  }
  static double away(unsigned k, const Vec3<double>& p) {
    return ask_class<Classes...>(k, [&](auto c) { return decltype(c)::away(places[k], p); });
  }
  static double distance(unsigned k, const Vec3<double>& p, const Direction<double>& v,
                         double reach, double tol) {
    return ask_class<Classes...>(k, [&](auto c) {
      return decltype(c)::template distance<false>(table, places[k], k, p, v, reach, tol);
    });
  }
  static double entry(unsigned k, const Vec3<double>& p, const Direction<double>& v, double reach,
                      double tol) {
    return ask_class<Classes...>(k, [&](auto c) {
      return decltype(c)::template distance<true>(table, places[k], k, p, v, reach, tol);
    });
  }
  template <class Frame>
  static void push(NavigationStack* stack, unsigned k) {
    push_of_class<Frame, shared, any_rotated, all_rotated>(stack, places[k], k);
  }
};

}  // namespace navjit::kernels
