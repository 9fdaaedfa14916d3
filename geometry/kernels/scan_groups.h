// Some hundreds or thousands of daughters: a scan (scan.h) of boxes around eight of them that are
// close together, then of the boxes of those eights that the ray may meet, before any daughter is
// asked. Of thousands, boxes around eight times eight are looked at before.
namespace navjit::kernels {

/// So many boxes at most: a key has the number of its block and lane in its last bits.
constexpr unsigned most_grouped = 16384;
/// From so many blocks on, groups have boxes around them. Below, all are looked at.
constexpr unsigned blocks_with_halls = 129;

struct SearchGroups {
  using Key = ScanKeys<14>;
  NearBoxes boxes;        ///< of the daughters; all blocks are full but the last
  const BoxBlock* halls;  ///< lane l of hall h is around group h * box_lanes + l; null: none

  /// Blocks within one hall.
  static constexpr unsigned in_hall = box_lanes * box_lanes;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    const auto look_at = [&](unsigned group) {
      unsigned lanes = lanes_around(boxes.groups[group], p);
      for (; lanes != 0; lanes &= lanes - 1) {
        const unsigned m = box_lanes * group + static_cast<unsigned>(__builtin_ctz(lanes));
        visit_blocks_around(boxes.blocks + m, boxes.daughters + m, 1, p,
                            [&](unsigned k) { last(k); });
      }
    };
    if (halls == nullptr) {
      for (unsigned g = 0; g * box_lanes < boxes.count; ++g) look_at(g);
      return last.found;
    }
    for (unsigned h = 0; h * in_hall < boxes.count; ++h) {
      for (unsigned lanes = lanes_around(halls[h], p); lanes != 0; lanes &= lanes - 1) {
        look_at(box_lanes * h + static_cast<unsigned>(__builtin_ctz(lanes)));
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
    float end = static_cast<float>(smaller(limit, best));
    ScanRay ray(p, v, end);
    const unsigned left = left_by_ray(d);
    constexpr unsigned room = in_hall;
    Keys keys[2 * room];
    Keys least = Key::all(Key::none);
    unsigned met = 0;
    const auto ask = [&] {
      ask_in_order<Key>(keys, met, Key::least(least), end, nearest, [&](unsigned number) {
        return boxes.daughters[number / box_lanes][number % box_lanes];
      });
    };
    // Which of a hall's groups and blocks are met are words of bits: what a single group has
    // cannot be foreseen.
    for (unsigned first = 0; first < boxes.count; first += in_hall) {
      const BoxBlock* groups = boxes.groups + first / box_lanes;
      const auto blocks_in = [&](unsigned group) {
        Floats enter;
        const auto lanes = lanes_of(ray.meets(groups[group].low, enter));
        return static_cast<unsigned long long>(lanes) << (box_lanes * group);
      };
      unsigned long long blocks = 0;
      if (halls == nullptr) {
        const unsigned here = smaller(boxes.count - first, in_hall);
        for (unsigned g = 0; g * box_lanes < here; ++g) blocks |= blocks_in(g);
      } else {
        Floats enter;
        unsigned lanes = lanes_of(ray.meets(halls[first / in_hall].low, enter));
        for (; lanes != 0; lanes &= lanes - 1) {
          blocks |= blocks_in(static_cast<unsigned>(__builtin_ctz(lanes)));
        }
      }
      for (; blocks != 0; blocks &= blocks - 1) {
        const unsigned m = first + static_cast<unsigned>(__builtin_ctzll(blocks));
        Keys daughters;
        __builtin_memcpy(&daughters, boxes.daughters[m], sizeof daughters);
        const Keys numbers = Key::all(box_lanes * m) + Keys{0, 1, 2, 3, 4, 5, 6, 7};
        keys[met] = keys_of<Key>(boxes.blocks[m].low, ray, numbers, daughters, left);
        least = Key::smaller_keys(least, keys[met++]);
      }
      if (met <= room) continue;
      // No room for those of another hall.
      ask();
      end = static_cast<float>(smaller(nearest.limit, nearest.best));
      ray.leave_all = all_lanes(end * path_slack);
      least = Key::all(Key::none);
      met = 0;
    }
    ask();
    return nearest.hit;
  }
};

}  // namespace navjit::kernels
