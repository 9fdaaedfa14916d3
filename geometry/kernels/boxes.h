// Boxes around daughters, eight to a block, tested at once in single precision. The tests only find
// candidates. The boxes include a margin for all rounding here, and the daughters in boxes that may
// be met are then asked in double precision.
namespace navjit::kernels {

typedef float Floats __attribute__((vector_size(32)));
typedef int Ints __attribute__((vector_size(32)));
constexpr int box_lanes = 8;

/// Bounds by axis, mm; empty lanes have low = +infinity and high = -infinity.
struct BoxBlock {
  Floats low[3], high[3];
};

/// The same as CellGrid, with blocks of boxes instead of daughters.
template <class Index>
struct BlockGrid {
  int count[3];
  double origin[3], width[3], per_mm[3];  ///< per_mm = 1 / width
  const unsigned* first;                  ///< by cell: start in blocks
  const BoxBlock* blocks;
  const Index (*daughters)[box_lanes];  ///< ascending within a cell
};

/// One bit for each lane, which is 1 if the lane is set. A set lane has all bits 1, any other lane
/// has all bits 0.
inline unsigned lanes_of(Ints set) {
#if defined(__clang__)
  typedef bool Bits __attribute__((ext_vector_type(8)));
  return __builtin_bit_cast(unsigned char, __builtin_convertvector(set, Bits));
#elif defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskps256(__builtin_bit_cast(Floats, set)));
#else
  unsigned bits = 0;
  for (int i = 0; i < box_lanes; ++i) bits |= set[i] != 0 ? 1U << i : 0U;
  return bits;
#endif
}

inline Floats all_lanes(float x) { return Floats{x, x, x, x, x, x, x, x}; }
inline Floats larger_lanes(Floats a, Floats b) { return a > b ? a : b; }
inline Floats smaller_lanes(Floats a, Floats b) { return a < b ? a : b; }

/// A ray in single precision. Reciprocals are limited to 1e30, so that they are finite; scenes are
/// far smaller than that.
struct FloatRay {
  Floats p[3], inverse[3];
  bool down[3];
};

inline float finite_inverse(double inverse) {
  return static_cast<float>(smaller(larger(inverse, -1e30), 1e30));
}

inline FloatRay float_ray(const Vec3<double>& p, const Direction<double>& v) {
  return {{all_lanes(static_cast<float>(p.x)), all_lanes(static_cast<float>(p.y)),
           all_lanes(static_cast<float>(p.z))},
          {all_lanes(finite_inverse(v.inverse_x)), all_lanes(finite_inverse(v.inverse_y)),
           all_lanes(finite_inverse(v.inverse_z))},
          {v.x < 0, v.y < 0, v.z < 0}};
}

/// The relative slack in comparisons of path lengths, each of which has four roundings.
constexpr float path_slack = 1 + 0x1p-20f;

/// The lanes whose boxes the ray may meet between `from` and `to`, path lengths >= 0. `enter`
/// receives lower bounds of the paths to the boxes.
inline unsigned lanes_met(const BoxBlock& block, const FloatRay& ray, float from, float to,
                          Floats& enter) {
  enter = all_lanes(from / path_slack);
  Floats leave = all_lanes(to * path_slack);
  for (int axis = 0; axis < 3; ++axis) {
    const Floats near = ray.down[axis] ? block.high[axis] : block.low[axis];
    const Floats far = ray.down[axis] ? block.low[axis] : block.high[axis];
    enter = larger_lanes((near - ray.p[axis]) * ray.inverse[axis], enter);
    leave = smaller_lanes((far - ray.p[axis]) * ray.inverse[axis], leave);
  }
  return lanes_of(enter <= leave * all_lanes(path_slack));
}

/// The lanes whose boxes may hold the point.
inline unsigned lanes_around(const BoxBlock& block, const Vec3<double>& p) {
  const Floats x = all_lanes(static_cast<float>(p.x)), y = all_lanes(static_cast<float>(p.y)),
               z = all_lanes(static_cast<float>(p.z));
  return lanes_of((block.low[0] <= x) & (x <= block.high[0]) & (block.low[1] <= y) &
                  (y <= block.high[1]) & (block.low[2] <= z) & (z <= block.high[2]));
}

/// The first of `count` numbers of daughters for which holds(number) is true; -1 for none. `blocks`
/// has the daughters' boxes in the same order. A daughter is asked only if the point is in its box.
template <class Index, class Holds>
inline int first_around(const BoxBlock* blocks, const Index* numbers, unsigned count,
                        const Vec3<double>& p, Holds holds) {
  for (unsigned first = 0; first < count; first += box_lanes) {
    for (unsigned lanes = lanes_around(*blocks++, p); lanes != 0; lanes &= lanes - 1) {
      const auto number = numbers[first + static_cast<unsigned>(__builtin_ctz(lanes))];
      if (holds(static_cast<unsigned>(number))) return static_cast<int>(number);
    }
  }
  return -1;
}

/// Floats strictly below and above a double, as the boxes of the generic navigator use them
/// (geometry/bvh/rounding.hpp).
inline float strictly_below(double x) {
  if (absolute(x) == infinity<double>()) {
    return x < 0 ? -__builtin_inff() : __FLT_MAX__;
  }
  const double shifted = x - (absolute(x) * 0x1p-23 + 0x1p-100);
  return static_cast<float>(shifted < __FLT_MAX__ ? shifted : double(__FLT_MAX__));
}
inline float strictly_above(double x) { return -strictly_below(-x); }

inline Floats root_of_lanes(Floats x) {
#if defined(__clang__)
  return __builtin_elementwise_sqrt(x);
#elif defined(__AVX__)
  return __builtin_ia32_sqrtps256(x);
#else
  for (int i = 0; i < box_lanes; ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
#endif
}

/// The first lane that has the smallest number.
inline unsigned least_lane(Floats x) {
  Floats least = smaller_lanes(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
  least = smaller_lanes(least, __builtin_shufflevector(least, least, 2, 3, 0, 1, 6, 7, 4, 5));
  least = smaller_lanes(least, __builtin_shufflevector(least, least, 1, 0, 3, 2, 5, 4, 7, 6));
  return static_cast<unsigned>(__builtin_ctz(lanes_of(x <= least)));
}

/// Distances of a point from boxes, with the same bits as in the generic navigator
/// (bvh::BoxTree::near).
struct BoxDistances {
  Floats below[3], above[3];

  explicit BoxDistances(const Vec3<double>& p)
      : below{all_lanes(strictly_below(p.x)), all_lanes(strictly_below(p.y)),
              all_lanes(strictly_below(p.z))},
        above{all_lanes(strictly_above(p.x)), all_lanes(strictly_above(p.y)),
              all_lanes(strictly_above(p.z))} {}

  Floats squares(const BoxBlock& block) const {
    Floats square = all_lanes(0);
    for (int axis = 0; axis < 3; ++axis) {
      const Floats outside =
          larger_lanes(larger_lanes(block.low[axis] - above[axis], below[axis] - block.high[axis]),
                       all_lanes(0));
      square += outside * outside;
    }
    return smaller_lanes(square, all_lanes(__FLT_MAX__));
  }
  static Floats distances(Floats squares) {
    return root_of_lanes(squares) * all_lanes(1 - 0x1p-21f);
  }

  /// A lower bound of the distance to a box: the distance along the axis on which this is largest.
  /// 0 within a box.
  Floats along_axes(const BoxBlock& block) const {
    Floats most = all_lanes(0);
    for (int axis = 0; axis < 3; ++axis) {
      most = larger_lanes(most, block.low[axis] - above[axis]);
      most = larger_lanes(most, below[axis] - block.high[axis]);
    }
    return most * all_lanes(1 - 0x1p-21f);
  }
};

/// The boxes of daughters, as safeties and SearchGroups use them: blocks of daughters that are
/// close together, and boxes around whole blocks.
struct NearBoxes {
  const BoxBlock* groups;                  ///< lane l of group g is around block g * box_lanes + l
  const BoxBlock* blocks;                  ///< null: none
  const unsigned (*daughters)[box_lanes];  ///< by block
  unsigned count;                          ///< of blocks
};

/// The smallest of `safety` and max(bound, away(k)) of all daughters k, where `bound` is the
/// distance to the daughter's box. The bound makes the answer independent of which daughters are
/// asked. In each group the nearest block is asked first, which saves asking most of the others.
template <class Away>
inline double safety_near_boxes(const NearBoxes& boxes, const Vec3<double>& p, double safety,
                                Away away) {
  const BoxDistances from(p);
  // The nearest box is asked first: usually its daughter is nearer than all other boxes.
  const auto ask = [&](unsigned m) {
    Floats distance = BoxDistances::distances(from.squares(boxes.blocks[m]));
    while (lanes_of(distance < all_lanes(strictly_above(safety))) != 0) {
      const unsigned lane = least_lane(distance);
      const double bound = static_cast<double>(distance[lane]);
      if (!(bound < safety)) return;
      safety = smaller(larger(away(boxes.daughters[m][lane]), bound), safety);
      distance[lane] = __builtin_inff();
    }
  };
  if (boxes.count == 1) {
    ask(0);
    return safety;
  }
  // This is rounded up, so that no box that is nearer is left out. `ask` decides about the boxes
  // that are offered.
  const auto enough = [&] { return all_lanes(strictly_above(safety * safety * (1 + 0x1p-18))); };
  for (unsigned first = 0; first < boxes.count; first += box_lanes) {
    const Floats squares = from.squares(boxes.groups[first / box_lanes]);
    const unsigned there =
        boxes.count - first < box_lanes ? (1U << (boxes.count - first)) - 1 : ~0U;
    unsigned lanes = lanes_of(squares <= enough()) & there;
    if (lanes == 0) continue;
    if ((lanes & (lanes - 1)) != 0) {
      const unsigned nearest = least_lane(squares);
      ask(first + nearest);
      lanes &= lanes_of(squares <= enough()) & ~(1U << nearest);
    }
    for (; lanes != 0; lanes &= lanes - 1) {
      const unsigned lane = static_cast<unsigned>(__builtin_ctz(lanes));
      if (squares[lane] <= enough()[0]) ask(first + lane);
    }
  }
  return safety;
}

/// Calls visit(daughter) for the daughters in a few blocks of boxes that may hold the point.
template <class Index, class Visit>
inline void visit_blocks_around(const BoxBlock* blocks, const Index (*daughters)[box_lanes],
                                unsigned count, const Vec3<double>& p, const Visit& visit) {
  for (unsigned m = 0; m < count; ++m) {
    for (unsigned lanes = lanes_around(blocks[m], p); lanes != 0; lanes &= lanes - 1) {
      visit(static_cast<unsigned>(daughters[m][__builtin_ctz(lanes)]));
    }
  }
}

/// Calls visit(daughter) for the daughters in blocks `first` to `last` - 1 whose boxes the ray may
/// meet between the path lengths `from` and `smaller(reach(), to)`.
template <class Index, class Visit, class Reach>
inline void visit_blocks(const BoxBlock* blocks, const Index (*daughters)[box_lanes],
                         unsigned first, unsigned last, const FloatRay& ray, double from, double to,
                         const Visit& visit, const Reach& reach) {
  // A path beyond single precision is rounded to infinity, which serves as well.
  float end = static_cast<float>(smaller(reach(), to));
  for (unsigned m = first; m < last; ++m) {
    Floats enter;
    for (unsigned lanes = lanes_met(blocks[m], ray, static_cast<float>(from), end, enter);
         lanes != 0; lanes &= lanes - 1) {
      const unsigned lane = static_cast<unsigned>(__builtin_ctz(lanes));
      if (enter[lane] > end * path_slack * path_slack) continue;
      visit(static_cast<unsigned>(daughters[m][lane]));
      end = static_cast<float>(smaller(reach(), to));
    }
  }
}

/// Calls visit(daughter) for the daughters whose boxes may hold the point, in descending file
/// order, until visit returns false.
template <class Index, class Visit>
inline void visit_blocks_at(const BlockGrid<Index>& g, const Vec3<double>& p, const Visit& visit) {
  const unsigned b = cell_at(g, p);
  for (unsigned m = g.first[b + 1]; m-- > g.first[b];) {
    for (unsigned lanes = lanes_around(g.blocks[m], p); lanes != 0;) {
      const unsigned lane = 31U - static_cast<unsigned>(__builtin_clz(lanes));
      lanes ^= 1U << lane;
      if (!visit(static_cast<unsigned>(g.daughters[m][lane]))) return;
    }
  }
}

/// Calls visit(daughter) for the daughters whose boxes the ray may meet within `reach()`, a path
/// length that visits may shorten.
template <class Index, class Visit, class Reach>
inline void walk_blocks(const BlockGrid<Index>& g, const Vec3<double>& p,
                        const Direction<double>& v, const Visit& visit, const Reach& reach) {
  const FloatRay ray = float_ray(p, v);
  walk_grid(
      g, p, v,
      [&](unsigned b, double from, double to) {
        visit_blocks(g.blocks, g.daughters, g.first[b], g.first[b + 1], ray, from, to, visit,
                     reach);
      },
      reach);
}

}  // namespace navjit::kernels
