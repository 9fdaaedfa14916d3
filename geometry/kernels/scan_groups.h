// A search for some hundreds or thousands of daughters. A *block* has the boxes of eight daughters
// that are close together, a *group* has boxes around eight blocks, and a *hall*, which only
// thousands of daughters have, has boxes around eight groups. The search tests halls, then the
// groups and then the blocks that the ray may meet, before it asks any daughter. A straight ray
// that comes back from a daughter meets the same boxes again, so these are kept (BoxesAhead).
namespace navjit::kernels {

/// The largest number of boxes: a key has the number of the block and the lane in its last 14 bits.
constexpr unsigned most_grouped = 16384;
/// With at least this number of blocks there are halls. With fewer, all groups are tested.
constexpr unsigned blocks_with_halls = 129;

/// Keeps a block of boxes as number `m`.
inline void keep_boxes(BoxesAhead& ahead, unsigned m, const Keys& keys, const Floats& leave) {
  __builtin_memcpy(ahead.keys[m], &keys, sizeof keys);
  __builtin_memcpy(ahead.leave[m], &leave, sizeof leave);
}

/// Notes that the boxes kept are all that the ray meets from `p` up to the path `until`.
inline void all_are_kept(BoxesAhead& ahead, const void* search, unsigned long long mother,
                         const Vec3<double>& p, float until, unsigned count) {
  ahead.search = search;
  ahead.mother = mother;
  ahead.at[0] = p.x;
  ahead.at[1] = p.y;
  ahead.at[2] = p.z;
  // Tests of boxes have some slack, so boxes that the ray enters a little later are kept, too.
  ahead.until = static_cast<double>(until) * (1 + 0x1p-21);
  ahead.count = count;
}

/// Asks the daughters whose boxes a search found from an earlier point of the ray. Returns false,
/// and asks no daughter, if the boxes may not be all that the ray meets.
///
/// The point may be a little off the ray along which the boxes were found. That is safe, as boxes
/// are larger than daughters by far more (docs/numerics.md).
template <class Key, class Nearest, class DaughterOf>
[[gnu::always_inline]] inline bool ask_boxes_ahead(const BoxesAhead& ahead, const void* search,
                                                   unsigned long long mother, Nearest& nearest,
                                                   const DaughterOf& daughter_of) {
  if (ahead.search != search || ahead.mother != mother) return false;
  const Vec3<double>& p = nearest.p;
  const Direction<double>& v = nearest.v;
  const double x = p.x - ahead.at[0], y = p.y - ahead.at[1], z = p.z - ahead.at[2];
  const double gone = x * v.x + y * v.y + z * v.z;
  const double off =
      larger(absolute(x - gone * v.x), larger(absolute(y - gone * v.y), absolute(z - gone * v.z)));
  const double end = gone + smaller(nearest.limit, nearest.best);
  if (!((off <= 0.25 * nearest.tol) & (gone >= 0) & (end <= ahead.until))) return false;
  const Floats behind = all_lanes(static_cast<float>(gone) / path_slack);
  Keys keys[BoxesAhead::room];
  Keys least = Key::all(Key::none);
  for (unsigned m = 0; m < ahead.count; ++m) {
    Keys key;
    Floats leave;
    __builtin_memcpy(&key, ahead.keys[m], sizeof key);
    __builtin_memcpy(&leave, ahead.leave[m], sizeof leave);
    keys[m] = leave * all_lanes(path_slack) >= behind ? key : Key::all(Key::none);
    least = Key::smaller_keys(least, keys[m]);
  }
  ask_in_order<Key>(keys, ahead.count, Key::least(least), static_cast<float>(end), nearest,
                    daughter_of, [&](double path) { return gone + path; });
  return true;
}

/// Where boxes may be kept, or null; and the touchable for which they are kept.
template <class Daughters>
[[gnu::always_inline]] inline BoxesAhead* place_for_boxes(const Daughters& d) {
  if constexpr (requires { d.boxes_ahead; }) return d.boxes_ahead;
  return nullptr;
}
template <class Daughters>
[[gnu::always_inline]] inline unsigned long long mother_of(const Daughters& d) {
  if constexpr (requires { d.boxes_ahead; }) return d.mother;
  return 0;
}

struct SearchGroups {
  using Key = ScanKeys<14>;
  static constexpr bool remembers_boxes = true;
  NearBoxes boxes;        ///< of the daughters; all blocks except the last are full
  const BoxBlock* halls;  ///< lane l of hall h is around group h * box_lanes + l; null: none

  /// The number of blocks within one hall.
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
    const auto daughter_of = [this](unsigned number) {
      return boxes.daughters[number / box_lanes][number % box_lanes];
    };
    BoxesAhead* const ahead = place_for_boxes(d);
    if (ahead != nullptr) {
      if (ask_boxes_ahead<Key>(*ahead, this, mother_of(d), nearest, daughter_of)) {
        return nearest.hit;
      }
      ahead->search = nullptr;
    }
    // A path beyond single precision is rounded to infinity, which serves as well.
    float end = static_cast<float>(smaller(limit, best));
    const float until = end;
    ScanRay ray(p, v, end);
    const unsigned left = left_by_ray(d);
    constexpr unsigned room = in_hall;
    Keys keys[2 * room];
    Keys least = Key::all(Key::none);
    unsigned met = 0;
    bool all_kept = true;
    const auto ask = [&] {
      ask_in_order<Key>(keys, met, Key::least(least), end, nearest, daughter_of,
                        [](double path) { return path; });
    };
    // The groups and blocks of a hall that the ray meets are collected as bits of words, because
    // branches on single groups are unpredictable.
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
        Floats leave;
        keys[met] = keys_of<Key>(boxes.blocks[m].low, ray, numbers, daughters, left, leave);
        least = Key::smaller_keys(least, keys[met]);
        if (ahead != nullptr && met < BoxesAhead::room) keep_boxes(*ahead, met, keys[met], leave);
        // This has no branch, because it is unpredictable which blocks have boxes that the ray
        // meets.
        met += lanes_of(keys[met] != Key::all(Key::none)) != 0 ? 1U : 0U;
      }
      if (met <= room) continue;
      // There is no room for the keys of another hall.
      all_kept = false;
      ask();
      end = static_cast<float>(smaller(limit, best));
      ray.leave_all = all_lanes(end * path_slack);
      least = Key::all(Key::none);
      met = 0;
    }
    if (ahead != nullptr && all_kept && met <= BoxesAhead::room) {
      all_are_kept(*ahead, this, mother_of(d), p, until, met);
    }
    ask();
    return nearest.hit;
  }
};

}  // namespace navjit::kernels
