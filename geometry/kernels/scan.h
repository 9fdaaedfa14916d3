// Some dozens of daughters, the boxes of all of them looked at before any daughter is asked. What a
// ray meets cannot be foreseen, and a branch that is foreseen wrongly is dear: here nothing
// branches on it but whether another daughter is asked.
namespace navjit::kernels {

typedef unsigned Keys __attribute__((vector_size(32)));

/// So many boxes at most: a key has their number in its last bits.
constexpr unsigned most_scanned = 64;

/// Boxes that a ray meets, as numbers in the order of where it enters them: the bits of that path
/// length, which are ordered as it is, with the number of the box in the place of the last six.
struct ScanKeys {
  static constexpr unsigned number_bits = most_scanned - 1;
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
  /// At most the path length.
  static float enter(unsigned key) { return __builtin_bit_cast(float, key & ~number_bits); }
};

/// Of the daughters; `blocks` holds their boxes in file order.
struct SearchScan {
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
    // Rounded, a number beyond single precision is infinite, which serves as well.
    float end = static_cast<float>(smaller(limit, best));
    Keys keys[most_scanned / box_lanes];
    unsigned left = none_of_them;
    if constexpr (requires { d.left_for_good; }) left = d.left_for_good;
    unsigned next = first_key(p, v, end, left, keys);
    while (next != ScanKeys::none && ScanKeys::enter(next) <= end * path_slack * path_slack) {
      nearest(ScanKeys::number(next));
      end = static_cast<float>(smaller(limit, best));
      Keys least = ScanKeys::all(ScanKeys::none);
      for (unsigned m = 0; m < count; ++m) {
        const Keys after = keys[m] > next ? keys[m] : ScanKeys::all(ScanKeys::none);
        least = ScanKeys::smaller_keys(least, after);
      }
      next = ScanKeys::least(least);
    }
    return nearest.hit;
  }

 private:
  static constexpr unsigned none_of_them = ~0U;

  /// All but `left`.
  [[gnu::always_inline]] unsigned first_key(const Vec3<double>& p, const Direction<double>& v,
                                            float end, unsigned left, Keys* keys) const {
    const FloatRay ray = float_ray(p, v);
    const Floats leave_all = all_lanes(end * path_slack);
    // Rows of a block: where its boxes begin along each axis, then where they end.
    const int near_x = ray.down[0] ? 3 : 0, near_y = ray.down[1] ? 4 : 1,
              near_z = ray.down[2] ? 5 : 2;
    const int far_x = 3 - near_x, far_y = 5 - near_y, far_z = 7 - near_z;
    Keys least = ScanKeys::all(ScanKeys::none), numbers = {0, 1, 2, 3, 4, 5, 6, 7};
    const Floats* row = blocks[0].low;
    for (unsigned m = 0; m < count; ++m, row += 6) {
      Floats enter = larger_lanes((row[near_x] - ray.p[0]) * ray.inverse[0], all_lanes(0));
      enter = larger_lanes((row[near_y] - ray.p[1]) * ray.inverse[1], enter);
      enter = larger_lanes((row[near_z] - ray.p[2]) * ray.inverse[2], enter);
      Floats leave = smaller_lanes((row[far_x] - ray.p[0]) * ray.inverse[0], leave_all);
      leave = smaller_lanes((row[far_y] - ray.p[1]) * ray.inverse[1], leave);
      leave = smaller_lanes((row[far_z] - ray.p[2]) * ray.inverse[2], leave);
      const Keys key =
          (__builtin_bit_cast(Keys, enter) & ~ScanKeys::all(ScanKeys::number_bits)) | numbers;
      const auto met = (enter <= leave * all_lanes(path_slack)) & (numbers != ScanKeys::all(left));
      keys[m] = met ? key : ScanKeys::all(ScanKeys::none);
      least = ScanKeys::smaller_keys(least, keys[m]);
      numbers += ScanKeys::all(box_lanes);
    }
    return ScanKeys::least(least);
  }
};

}  // namespace navjit::kernels
