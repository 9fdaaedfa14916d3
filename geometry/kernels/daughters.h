// The daughters of a scene, by number: whether one holds a point, how far along a ray it is, how
// far away it is, and which level of the stack it becomes. Each kind of scene has the kind of table
// that it needs and no more. For instance, a table of boxes has their sizes beside their places.
namespace navjit::kernels {

/// Where a daughter's own daughters are.
enum InnerDaughters : unsigned short {
  has_surface_daughters,  ///< some may be at its surface, where steps enter it
  no_daughters,
  deep_daughters,  ///< none is near its surface, where steps enter it
};

/// A scene without daughters.
struct NoDaughters {
  static constexpr bool any = false;
};

/// A box placed without a rotation; a cache line.
struct BoxDaughter {
  double x, y, z;     ///< the centre in the mother's frame, mm
  double hx, hy, hz;  ///< half lengths, mm
  unsigned long long offset;
  unsigned volume;
  InnerDaughters inner;
};

struct BoxDaughters {
  static constexpr bool any = true;
  static constexpr unsigned listed = 0;  ///< how many daughters are types of their own
  const BoxDaughter* at;
  unsigned count;

  /// Prefetches the record of a daughter that will be asked. (Unless it is always inlined, GCC 12
  /// removes the call.)
  [[gnu::always_inline]] void fetch(unsigned k) const { __builtin_prefetch(at + k); }

  [[gnu::always_inline]] bool holds(unsigned k, const Vec3<double>& p, const Direction<double>& v,
                                    double tol) const {
    const BoxDaughter& d = at[k];
    return contains(Box<double>{d.hx, d.hy, d.hz}, Vec3<double>{p.x - d.x, p.y - d.y, p.z - d.z}, v,
                    tol);
  }
  [[gnu::always_inline]] double distance(unsigned k, const Vec3<double>& p,
                                         const Direction<double>& v, double, double tol) const {
    const BoxDaughter& d = at[k];
    return distance_to_in(Box<double>{d.hx, d.hy, d.hz},
                          Vec3<double>{p.x - d.x, p.y - d.y, p.z - d.z}, v, tol);
  }
  [[gnu::always_inline]] double entry(unsigned k, const Vec3<double>& p, const Direction<double>& v,
                                      double, double tol) const {
    const BoxDaughter& d = at[k];
    return distance_to_entry(Box<double>{d.hx, d.hy, d.hz},
                             Vec3<double>{p.x - d.x, p.y - d.y, p.z - d.z}, v, tol);
  }
  static bool leaves_for_good(unsigned, const Vec3<double>&, double) { return true; }
  [[gnu::always_inline]] double away(unsigned k, const Vec3<double>& p) const {
    const BoxDaughter& d = at[k];
    return safety_to_in(Box<double>{d.hx, d.hy, d.hz},
                        Vec3<double>{p.x - d.x, p.y - d.y, p.z - d.z});
  }
  template <class Frame>
  [[gnu::always_inline]] void push(NavigationStack* stack, unsigned k) const {
    const BoxDaughter& d = at[k];
    if (!Frame::rotated && stack->levels[stack->depth].rotation != nullptr) {
      __builtin_unreachable();
    }
    push_translated(stack, d.volume, k, d.offset, d.x, d.y, d.z);
  }
};

/// A daughter with any solid, placed in any way; a cache line.
template <class Solid>
struct SolidDaughter {
  double x, y, z;          ///< translation in the mother's frame, mm
  const double* rotation;  ///< null: none
  Solid solid;
  unsigned long long offset;
  unsigned volume;
  InnerDaughters inner;
  bool boxed;                 ///< whether its box is tested first, as its solid is costly
  bool can_be_left_for_good;  ///< whether leaves_for_good may be true
};

template <class Solid>
struct SolidDaughters {
  static constexpr bool any = true;
  static constexpr unsigned listed = 0;  ///< how many daughters are types of their own
  const SolidDaughter<Solid>* at;
  const Vec3<double> (*boxes)[2];  ///< corners of the solids' boxes, with a margin, mm
  unsigned count;

  /// Prefetches the record of a daughter that will be asked.
  [[gnu::always_inline]] void fetch(unsigned k) const { __builtin_prefetch(at + k); }

  static Vec3<double> turned(const double* r, double x, double y, double z) {
    return {r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z,
            r[6] * x + r[7] * y + r[8] * z};
  }
  [[gnu::always_inline]] static Vec3<double> local(const SolidDaughter<Solid>& d,
                                                   const Vec3<double>& p) {
    const double x = p.x - d.x, y = p.y - d.y, z = p.z - d.z;
    return d.rotation == nullptr ? Vec3<double>{x, y, z} : turned(d.rotation, x, y, z);
  }
  [[gnu::always_inline]] bool holds(unsigned k, const Vec3<double>& p, const Direction<double>& v,
                                    double tol) const {
    const SolidDaughter<Solid>& d = at[k];
    const Vec3<double> q = local(d, p);
    if (d.boxed && !is_in_box(boxes[k][0], boxes[k][1], q)) return false;
    if (d.rotation == nullptr) return contains(d.solid, q, v, tol);
    const Vec3<double> u = turned(d.rotation, v.x, v.y, v.z);
    return contains(d.solid, q, make_heading<double>(u.x, u.y, u.z), tol);
  }
  [[gnu::always_inline]] double distance(unsigned k, const Vec3<double>& p,
                                         const Direction<double>& v, double reach,
                                         double tol) const {
    return distance_by(k, p, v, reach, [&](const Solid& solid, const auto& q, const auto& e, bool) {
      return distance_to_in(solid, q, e, tol);
    });
  }
  [[gnu::always_inline]] double entry(unsigned k, const Vec3<double>& p, const Direction<double>& v,
                                      double reach, double tol) const {
    return distance_by(
        k, p, v, reach, [&](const Solid& solid, const auto& q, const auto& e, bool rotated) {
          return rotated ? distance_to_in(solid, q, e, tol) : distance_to_entry(solid, q, e, tol);
        });
  }
  template <class Ask>
  [[gnu::always_inline]] double distance_by(unsigned k, const Vec3<double>& p,
                                            const Direction<double>& v, double reach,
                                            const Ask& ask) const {
    const SolidDaughter<Solid>& d = at[k];
    const Vec3<double> q = local(d, p);
    if (d.rotation == nullptr) {
      if (d.boxed && !may_meet_box(boxes[k][0], boxes[k][1], q, v, reach)) {
        return infinity<double>();
      }
      return ask(d.solid, q, v, false);
    }
    const Vec3<double> u = turned(d.rotation, v.x, v.y, v.z);
    const Direction<double> e = make_direction<double>(u.x, u.y, u.z);
    if (d.boxed && !may_meet_box(boxes[k][0], boxes[k][1], q, e, reach)) return infinity<double>();
    return ask(d.solid, q, e, true);
  }
  bool leaves_for_good(unsigned k, const Vec3<double>& p, double tol) const {
    const SolidDaughter<Solid>& d = at[k];
    return d.can_be_left_for_good && is_left_for_good(d.solid, local(d, p), tol);
  }
  [[gnu::always_inline]] double away(unsigned k, const Vec3<double>& p) const {
    return safety_to_in(at[k].solid, local(at[k], p));
  }
  template <class Frame>
  [[gnu::always_inline]] void push(NavigationStack* stack, unsigned k) const {
    const SolidDaughter<Solid>& d = at[k];
    if (!Frame::rotated && stack->levels[stack->depth].rotation != nullptr) {
      __builtin_unreachable();
    }
    if (d.rotation == nullptr) {
      push_translated(stack, d.volume, k, d.offset, d.x, d.y, d.z);
    } else {
      push_rotated(stack, d.volume, k, d.offset, d.x, d.y, d.z, d.rotation);
    }
  }
};

/// Daughters as the common step asks them, without rare cases. The distance to a daughter that
/// contains the start may be negative (distance_to_entry), and the daughter that the ray has left
/// for good is not asked. `is_oblique`: the ray is known to be oblique.
template <class Daughters, bool is_oblique>
struct MostlyAhead {
  static constexpr unsigned listed = Daughters::listed;
  const Daughters& all;
  unsigned count;
  unsigned left_for_good;
  BoxesAhead* boxes_ahead;    ///< for searches that remember boxes; may be null
  unsigned long long mother;  ///< the mother's touchable, for such searches

  [[gnu::always_inline]] void fetch(unsigned k) const {
    if constexpr (requires { all.fetch(k); }) all.fetch(k);
  }
  [[gnu::always_inline]] bool holds(unsigned k, const Vec3<double>& p, const Direction<double>& v,
                                    double tol) const {
    return all.holds(k, p, v, tol);
  }
  [[gnu::always_inline]] double distance(unsigned k, const Vec3<double>& p,
                                         const Direction<double>& v, double reach,
                                         double tol) const {
    return k == left_for_good ? infinity<double>() : all.entry(k, p, v, reach, tol);
  }
  template <unsigned k>
  [[gnu::always_inline]] double distance_one(const Vec3<double>& p, const Direction<double>& v,
                                             double reach, double tol) const {
    return k == left_for_good ? infinity<double>()
                              : all.template path_to_one<k, true>(p, v, reach, tol);
  }
};

/// Whether the type through which daughters are asked guarantees that the ray is oblique.
template <class Daughters>
constexpr bool knows_oblique = false;
template <class Daughters>
constexpr bool knows_oblique<MostlyAhead<Daughters, true>> = true;

}  // namespace navjit::kernels
