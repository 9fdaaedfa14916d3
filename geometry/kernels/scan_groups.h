// Some hundreds of daughters: a scan (scan.h) of boxes around eight of them that are close
// together, then of the boxes of those eights that the ray may meet, before any daughter is asked.
namespace navjit::kernels {

/// So many boxes at most: a key has the number of its block and lane in its last bits.
constexpr unsigned most_grouped = 1024;

struct SearchGroups {
  using Key = ScanKeys<10>;
  NearBoxes boxes;  ///< of the daughters; all blocks are full but the last

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    for (unsigned first = 0; first < boxes.count; first += box_lanes) {
      unsigned lanes = lanes_around(boxes.groups[first / box_lanes], p);
      for (; lanes != 0; lanes &= lanes - 1) {
        const unsigned m = first + static_cast<unsigned>(__builtin_ctz(lanes));
        visit_blocks_around(boxes.blocks + m, boxes.daughters + m, 1, p,
                            [&](unsigned k) { last(k); });
      }
    }
    return last.found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    // Rounded, a number beyond single precision is infinite, which serves as well.
    const float end = static_cast<float>(smaller(limit, best));
    const ScanRay ray(p, v, end);
    const unsigned left = left_by_ray(d);
    Keys keys[most_grouped / box_lanes];
    Keys least = Key::all(Key::none);
    unsigned met = 0;
    // A word of bits at a time: what a single group has cannot be foreseen.
    constexpr unsigned in_word = 64;
    for (unsigned first = 0; first < boxes.count; first += in_word) {
      const BoxBlock* groups = boxes.groups + first / box_lanes;
      const unsigned here = smaller(boxes.count - first, in_word);
      unsigned long long blocks = 0;
      for (unsigned m = 0; m < here; m += box_lanes) {
        Floats enter;
        const auto lanes = lanes_of(ray.meets(groups[m / box_lanes].low, enter));
        blocks |= static_cast<unsigned long long>(lanes) << m;
      }
      for (; blocks != 0; blocks &= blocks - 1) {
        const unsigned m = first + static_cast<unsigned>(__builtin_ctzll(blocks));
        Keys daughters;
        __builtin_memcpy(&daughters, boxes.daughters[m], sizeof daughters);
        const Keys numbers = Key::all(box_lanes * m) + Keys{0, 1, 2, 3, 4, 5, 6, 7};
        keys[met] = keys_of<Key>(boxes.blocks[m].low, ray, numbers, daughters, left);
        least = Key::smaller_keys(least, keys[met++]);
      }
    }
    ask_in_order<Key>(keys, met, Key::least(least), end, nearest, [&](unsigned number) {
      return boxes.daughters[number / box_lanes][number % box_lanes];
    });
    return nearest.hit;
  }
};

}  // namespace navjit::kernels
