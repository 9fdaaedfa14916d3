// Slabs within slabs (slabs.h). Each slab holds a daughter, a group of daughters, or slabs along
// another axis. The search only finds candidates; slabs include margins so that none is missed.
namespace navjit::kernels {

/// What is in a slab: the two highest bits say of what kind it is, and the others are its number.
namespace in_slab {
constexpr unsigned daughter = 0, slabs = 1U << 30, group = 2U << 30, kind = 3U << 30;
}

/// The blocks, from `first` to `last` - 1, of daughters that only their boxes tell apart.
struct LayerGroup {
  unsigned first, last;
};

template <class Index>
struct LayerRow {
  SlabRow<Index> slabs;  ///< `daughter` says what is in each slab, see in_slab
  int axis;
};

template <class Index>
struct LayerTree {
  const LayerRow<Index>* rows;  ///< the first row has all of the scene
  const LayerGroup* groups;
  const BoxBlock* blocks;
  const Index (*in_block)[box_lanes];
};

/// A ray whose reciprocals are limited, so that they are finite. A ray along slabs then stays in
/// its slab. What happens on the very edge of a slab, which is only a margin, does not matter.
struct LayerRay {
  double p[3], v[3], inverse[3];

  LayerRay(const Vec3<double>& at, const Direction<double>& along)
      : p{at.x, at.y, at.z},
        v{along.x, along.y, along.z},
        inverse{finite(along.inverse_x), finite(along.inverse_y), finite(along.inverse_z)} {}

 private:
  static double finite(double inverse) { return smaller(larger(inverse, -1e100), 1e100); }
};

/// Calls visit(daughter) for the daughters in slabs of the row that the ray passes between the path
/// lengths `from` and `to`, until it has passed `reach()`, a path length that visits may shorten.
template <class Index, class Visit, class Reach>
void walk_layers(const LayerTree<Index>& tree, const LayerRow<Index>& row, const LayerRay& ray,
                 const FloatRay& float_ray, double from, double to, Visit& visit, Reach& reach) {
  const SlabRow<Index>& s = row.slabs;
  const double p = ray.p[row.axis], v = ray.v[row.axis], inverse = ray.inverse[row.axis];
  const bool down = v < 0;
  const double *near = down ? s.high : s.low, *far = down ? s.low : s.high;
  const int last = down ? -1 : s.count, next = down ? -1 : 1;
  const int cell = cell_along(p + from * v, s.origin, s.per_mm, s.cells);
  for (int i = static_cast<int>((down ? s.descending : s.ascending)[cell]); i != last; i += next) {
    const double enter = larger((near[i] - p) * inverse, from);
    if (enter > smaller(reach(), to)) return;
    const double leave = smaller((far[i] - p) * inverse, to);
    if (enter > leave) continue;
    const unsigned what = s.daughter[i], number = what & ~in_slab::kind;
    switch (what & in_slab::kind) {
      case in_slab::daughter:
        visit(number);
        break;
      case in_slab::slabs:
        walk_layers(tree, tree.rows[number], ray, float_ray, enter, leave, visit, reach);
        break;
      default:
        visit_blocks(tree.blocks, tree.in_block, tree.groups[number].first,
                     tree.groups[number].last, float_ray, enter, leave, visit, reach);
    }
  }
}

/// Calls visit(daughter) for the daughters that may hold the point.
template <class Index, class Visit>
void visit_layers_at(const LayerTree<Index>& tree, const LayerRow<Index>& row,
                     const Vec3<double>& p, Visit& visit) {
  const SlabRow<Index>& s = row.slabs;
  const double at = row.axis == 0 ? p.x : row.axis == 1 ? p.y : p.z;
  const int cell = cell_along(at, s.origin, s.per_mm, s.cells);
  for (int i = static_cast<int>(s.ascending[cell]); i < s.count && s.low[i] <= at; ++i) {
    if (at > s.high[i]) continue;
    const unsigned what = s.daughter[i], number = what & ~in_slab::kind;
    switch (what & in_slab::kind) {
      case in_slab::daughter:
        visit(number);
        break;
      case in_slab::slabs:
        visit_layers_at(tree, tree.rows[number], p, visit);
        break;
      default: {
        const LayerGroup& group = tree.groups[number];
        visit_blocks_around(tree.blocks + group.first, tree.in_block + group.first,
                            group.last - group.first, p, visit);
      }
    }
  }
}

/// A point whose safety is asked, and the rounding error that its distances may have, mm.
struct LayerPoint {
  Vec3<double> p;
  double slack;
};

/// Squared lower bounds, by axis, of the distance of a point from what is in some slabs, mm^2.
struct LayersApart {
  double square[3] = {0, 0, 0};

  double sum() const { return square[0] + square[1] + square[2]; }
  /// The same for one slab more. If another of the slabs is along the same axis, the larger
  /// distance counts.
  LayersApart also(int axis, double distance) const {
    LayersApart both = *this;
    both.square[axis] = larger(square[axis], distance * distance);
    return both;
  }
};

/// The smallest of `safety` and ask(daughter, safety) for all daughters. Daughters in slabs that
/// are farther away are not asked. The nearest slab of a row, above or below the point, comes
/// first. `around`: the distances of the point from the slabs that contain the row.
template <class Index, class Ask>
double safety_among_layers(const LayerTree<Index>& tree, const LayerRow<Index>& row,
                           const LayerPoint& point, const LayersApart& around, double safety,
                           const Ask& ask) {
  const SlabRow<Index>& s = row.slabs;
  const double at = along_axis(point.p, row.axis);
  int above = static_cast<int>(s.ascending[cell_along(at, s.origin, s.per_mm, s.cells)]);
  while (above < s.count && s.high[above] < at) ++above;
  for (int below = above - 1;;) {
    const double up = above < s.count ? s.low[above] - at : infinity<double>();
    const double down = below >= 0 ? at - s.high[below] : infinity<double>();
    const LayersApart apart = around.also(row.axis, larger(smaller(up, down) - point.slack, 0.0));
    if (!(apart.sum() < safety * safety)) return safety;
    const unsigned what = s.daughter[up <= down ? above++ : below--];
    const unsigned number = what & ~in_slab::kind;
    switch (what & in_slab::kind) {
      case in_slab::daughter:
        safety = ask(number, safety);
        break;
      case in_slab::slabs:
        safety = safety_among_layers(tree, tree.rows[number], point, apart, safety, ask);
        break;
      default:
        for (unsigned m = tree.groups[number].first; m < tree.groups[number].last; ++m) {
          const float reach = strictly_above((safety + point.slack) * (safety + point.slack));
          const Ints near = BoxDistances(point.p).squares(tree.blocks[m]) <= all_lanes(reach);
          for (unsigned lanes = lanes_of(near); lanes != 0; lanes &= lanes - 1) {
            safety = ask(static_cast<unsigned>(tree.in_block[m][__builtin_ctz(lanes)]), safety);
          }
        }
    }
  }
}

template <class Index>
struct SearchLayers {
  LayerTree<Index> tree;
  const FloatBox* boxes;  ///< by daughter, as in the generic navigator; null if it has none
  double largest;         ///< the largest coordinate of any box, mm

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    const auto visit = [&](unsigned k) { last(k); };
    visit_layers_at(tree, tree.rows[0], p, visit);
    return last.found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    const auto visit = [&](unsigned k) { nearest(k); };
    const auto reach = [&] { return smaller(limit, best); };
    walk_layers(tree, tree.rows[0], LayerRay(p, v), float_ray(p, v), 0, infinity<double>(), visit,
                reach);
    return nearest.hit;
  }
  /// The smallest of `safety` and the safeties of the daughters. As in the generic navigator, that
  /// of a daughter is no less than the distance to its box, if there are boxes.
  template <class Daughters>
  [[gnu::always_inline]] double safety_among(const Daughters& d, const Vec3<double>& p,
                                             double safety) const {
    if (boxes == nullptr) {
      for (unsigned k = 0; k < d.count; ++k) safety = smaller(larger(d.away(k, p), 0.0), safety);
      return safety;
    }
    const BoxDistance from(p);
    const auto ask = [&](unsigned k, double least) {
      const double bound = from(boxes[k]);
      return bound < least ? smaller(larger(d.away(k, p), bound), least) : least;
    };
    const double far = larger(largest, larger(absolute(p.x), larger(absolute(p.y), absolute(p.z))));
    // A bound is less than the distance by the rounding of coordinates, and by its own.
    const LayerPoint point{p, (far + safety) * 0x1p-20};
    return safety_among_layers(tree, tree.rows[0], point, LayersApart{}, safety, ask);
  }
};

}  // namespace navjit::kernels
