// A search for some dozens of daughters. It tests the boxes of all of them before it asks any
// daughter. Which boxes a ray meets cannot be predicted, and a mispredicted branch is expensive.
// The only branch that depends on it is whether another daughter is asked.
namespace navjit::kernels {

typedef unsigned Keys __attribute__((vector_size(32)));

/// The boxes that a ray meets, as keys in the order in which it enters them. A key is the bits of
/// the path length to the box, which have the same order as the path lengths, with the number of
/// the box in place of the last `bits` bits.
template <unsigned bits>
struct ScanKeys {
  static constexpr unsigned number_bits = (1U << bits) - 1;
  static constexpr unsigned none = 0xffffffff;

  static Keys all(unsigned x) { return Keys{x, x, x, x, x, x, x, x}; }
  static Keys smaller_keys(Keys a, Keys b) { return a < b ? a : b; }
  static unsigned least(Keys k) {
    k = smaller_keys(k, __builtin_shufflevector(k, k, 4, 5, 6, 7, 0, 1, 2, 3));
    k = smaller_keys(k, __builtin_shufflevector(k, k, 2, 3, 0, 1, 6, 7, 4, 5));
    k = smaller_keys(k, __builtin_shufflevector(k, k, 1, 0, 3, 2, 5, 4, 7, 6));
    return k[0];
  }
  static unsigned number(unsigned key) { return key & number_bits; }
  /// The path length to the box, rounded down.
  static float enter(unsigned key) { return __builtin_bit_cast(float, key & ~number_bits); }
};

/// A ray that is tested against many blocks of boxes.
struct ScanRay {
  FloatRay ray;
  Floats leave_all;
  // Rows of a block: where its boxes begin along each axis, then where they end.
  int near_x, near_y, near_z, far_x, far_y, far_z;

  /// `end`: the path length at which the ray ends.
  [[gnu::always_inline]] ScanRay(const Vec3<double>& p, const Direction<double>& v, float end)
      : ray(float_ray(p, v)),
        leave_all(all_lanes(end * path_slack)),
        near_x(ray.down[0] ? 3 : 0),
        near_y(ray.down[1] ? 4 : 1),
        near_z(ray.down[2] ? 5 : 2),
        far_x(3 - near_x),
        far_y(5 - near_y),
        far_z(7 - near_z) {}

  /// The paths to where the ray enters and leaves the boxes of the block whose rows begin at `row`.
  /// The result has all bits set in the lanes of boxes that the ray meets.
  [[gnu::always_inline]] auto crosses(const Floats* row, Floats& enter, Floats& leave) const {
    enter = larger_lanes((row[near_x] - ray.p[0]) * ray.inverse[0], all_lanes(0));
    enter = larger_lanes((row[near_y] - ray.p[1]) * ray.inverse[1], enter);
    enter = larger_lanes((row[near_z] - ray.p[2]) * ray.inverse[2], enter);
    leave = smaller_lanes((row[far_x] - ray.p[0]) * ray.inverse[0], leave_all);
    leave = smaller_lanes((row[far_y] - ray.p[1]) * ray.inverse[1], leave);
    leave = smaller_lanes((row[far_z] - ray.p[2]) * ray.inverse[2], leave);
    return enter <= leave * all_lanes(path_slack);
  }
  [[gnu::always_inline]] auto meets(const Floats* row, Floats& enter) const {
    Floats leave;
    return crosses(row, enter, leave);
  }
};

/// The keys of the boxes of a block, which have the given numbers and are those of the given
/// daughters. The key is `none` if the ray does not meet the box, and for the daughter `left`.
/// `leave` receives the paths to where the ray leaves the boxes.
template <class Key>
[[gnu::always_inline]] inline Keys keys_of(const Floats* row, const ScanRay& ray, Keys numbers,
                                           Keys daughters, unsigned left, Floats& leave) {
  Floats enter;
  const auto met = ray.crosses(row, enter, leave) & (daughters != Key::all(left));
  const Keys key = (__builtin_bit_cast(Keys, enter) & ~Key::all(Key::number_bits)) | numbers;
  return met ? key : Key::all(Key::none);
}

/// Asks the daughters that keys stand for, in the order of the keys and beginning with `next`,
/// which is the least of all, until one is met before the ray enters the next box. `end` is where
/// the ray ends. `in_keys(path)` is a path from the ray's start as the keys and `end` count it.
template <class Key, class Nearest, class DaughterOf, class InKeys>
[[gnu::always_inline]] inline void ask_in_order(const Keys* keys, unsigned count, unsigned next,
                                                float end, Nearest& nearest,
                                                const DaughterOf& daughter_of,
                                                const InKeys& in_keys) {
  while (next != Key::none && Key::enter(next) <= end * path_slack * path_slack) {
    nearest(daughter_of(Key::number(next)));
    end = static_cast<float>(in_keys(smaller(nearest.limit, nearest.best)));
    Keys least = Key::all(Key::none);
    for (unsigned m = 0; m < count; ++m) {
      const Keys after = keys[m] > next ? keys[m] : Key::all(Key::none);
      least = Key::smaller_keys(least, after);
    }
    next = Key::least(least);
  }
  // The ray meets the next daughter when it comes back from the first one. By then the record that
  // is prefetched here has arrived. If there is no next daughter, another one is fetched, which
  // saves an unpredictable branch.
  if constexpr (requires { nearest.daughters.fetch(0U); }) {
    nearest.daughters.fetch(daughter_of(next != Key::none ? Key::number(next) : 0U));
  }
}

/// The daughter that the ray has left for good, if the type through which daughters are asked knows
/// it.
template <class Daughters>
[[gnu::always_inline]] inline unsigned left_by_ray(const Daughters& d) {
  if constexpr (requires { d.left_for_good; }) return d.left_for_good;
  return LeftForGood::none;
}

/// The largest number of boxes: a key has the number of a box in its last six bits.
constexpr unsigned most_scanned = 64;

/// The scan of all daughters; `blocks` holds their boxes in file order.
struct SearchScan {
  using Key = ScanKeys<6>;
  const BoxBlock* blocks;
  unsigned count;  ///< of blocks

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    unsigned long long around = 0;
    for (unsigned m = 0; m < count; ++m) {
      around |= static_cast<unsigned long long>(lanes_around(blocks[m], p)) << (box_lanes * m);
    }
    while (around != 0) {
      const int k = 63 - __builtin_clzll(around);
      if (k != blocked && d.holds(static_cast<unsigned>(k), p, v, tol)) return k;
      around ^= 1ULL << k;
    }
    return -1;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    // A path beyond single precision is rounded to infinity, which serves as well.
    const float end = static_cast<float>(smaller(limit, best));
    const ScanRay ray(p, v, end);
    const unsigned left = left_by_ray(d);
    Keys keys[most_scanned / box_lanes];
    Keys least = Key::all(Key::none), numbers = {0, 1, 2, 3, 4, 5, 6, 7};
    const Floats* row = blocks[0].low;
    Floats leave;
    for (unsigned m = 0; m < count; ++m, row += 6) {
      keys[m] = keys_of<Key>(row, ray, numbers, numbers, left, leave);
      least = Key::smaller_keys(least, keys[m]);
      numbers += Key::all(box_lanes);
    }
    ask_in_order<Key>(
        keys, count, Key::least(least), end, nearest, [](unsigned k) { return k; },
        [](double path) { return path; });
    return nearest.hit;
  }
};

}  // namespace navjit::kernels
