// The searches among a scene's daughters. Each finds candidates (by slabs, nest, rings, wires, grid
// or boxes) for the daughters' own kernels:
//   find(d, p, v, blocked, tol)
//       the last daughter in file order, other than `blocked`, that holds the point; -1 for none
//   nearest(d, p, v, best, limit, left, tol)
//       the first daughter in file order of those that the ray meets first, if it meets them before
//       the path `best`, which becomes the path to them; -1 for none. Daughters beyond the path
//       `limit` may be left out. `left`: the daughter that the track may have left last, or any
//       number
// A search offers all daughters that can be met, and perhaps others. Only the kernels decide.
namespace navjit::kernels {

struct NoSearch {};

/// Of the daughters that are offered, keeps the last in file order that holds the point.
template <class Daughters>
struct LastThatHolds {
  const Daughters& daughters;
  const Vec3<double>& p;
  const Direction<double>& v;
  int blocked;
  double tol;
  int found = -1;

  [[gnu::always_inline]] void operator()(unsigned k) {
    const int i = static_cast<int>(k);
    if (i > found && i != blocked && daughters.holds(k, p, v, tol)) found = i;
  }
};

/// Of the daughters that are offered, keeps the one that the ray meets first. Returns whether the
/// offered daughter became that one.
template <class Daughters>
struct NearestAhead {
  const Daughters& daughters;
  const Vec3<double>& p;
  const Direction<double>& v;
  double& best;
  double limit, tol;
  int hit = -1;

  [[gnu::always_inline]] bool operator()(unsigned k) {
    const double t = daughters.distance(k, p, v, smaller(limit, best), tol);
    if (t < best || (t == best && hit >= 0 && static_cast<int>(k) < hit)) {
      best = t;
      hit = static_cast<int>(k);
      return true;
    }
    return false;
  }
};

inline double along_axis(const Vec3<double>& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// Daughters that follow one another along an axis.
template <class Index>
struct SearchSlabs {
  SlabRow<Index> slabs;
  int axis;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    visit_slabs_at(slabs, along_axis(p, axis), [&](unsigned k) { last(k); });
    return last.found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned left, double tol) const {
    return nearest_by(*this, d, p, v, best, limit, left, tol);
  }

  const SearchSlabs& search() const { return *this; }
  double along(const Direction<double>& v) const { return along_axis({v.x, v.y, v.z}, axis); }
  double inverse(const Direction<double>& v) const {
    return along_axis({v.inverse_x, v.inverse_y, v.inverse_z}, axis);
  }

  /// `self.search()` is a SearchSlabs. The function out of line gets `self`, from which it makes
  /// the search again.
  template <class Self, class Daughters>
  [[gnu::always_inline]] static int nearest_by(const Self& self, const Daughters& d,
                                               const Vec3<double>& p, const Direction<double>& v,
                                               double& best, double limit, unsigned left,
                                               double tol) {
    const SearchSlabs& s = self.search();
    const double at = along_axis(p, s.axis), along = s.along(v);
    if constexpr (knows_oblique<Daughters>) {
      // Usually the ray meets the first slab. The loop over the others is out of line, as it would
      // take registers.
      const int i = first_slab<true>(s.slabs, at, along, left);
      if (i == end_of_slabs(s.slabs, along) ||
          slab_is_beyond(s.slabs, i, at, along, s.inverse(v), smaller(limit, best))) {
        return -1;
      }
      const unsigned k = s.slabs.daughter[i];
      const double t = d.distance(k, p, v, smaller(limit, best), tol);
      if (__builtin_expect(t < best, 1)) {
        best = t;
        return static_cast<int>(k);
      }
      const SlabFound found =
          nearest_from(self, d, along < 0 ? i - 1 : i + 1, p.x, p.y, p.z, v.x, v.y, v.z,
                       v.inverse_x, v.inverse_y, v.inverse_z, best, limit, tol);
      best = found.best;
      return found.hit;
    } else {
      NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
      walk_slabs(s.slabs, at, along, s.inverse(v), smaller(limit, best), left,
                 [&](unsigned k) { return nearest(k); });
      return nearest.hit;
    }
  }

 private:
  struct SlabFound {
    double best;
    int hit;
  };
  template <class Self, class Daughters>
  [[gnu::noinline, gnu::cold]] static SlabFound nearest_from(const Self& self, Daughters d, int i,
                                                             double x, double y, double z, double u,
                                                             double v, double w, double iu,
                                                             double iv, double iw, double best,
                                                             double limit, double tol) {
    const SearchSlabs& s = self.search();
    const Vec3<double> p{x, y, z};
    const Direction<double> e{u, v, w, iu, iv, iw};
    NearestAhead<Daughters> nearest{d, p, e, best, limit, tol};
    walk_slabs_from(s.slabs, i, along_axis(p, s.axis), s.along(e), s.inverse(e),
                    smaller(limit, best), [&](unsigned k) { return nearest(k); });
    return {best, nearest.hit};
  }
};

/// A regular partition of the scene with few daughters in each cell.
template <class Index>
struct SearchGrid {
  CellGrid<Index> grid;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    int found = -1;
    visit_cell_at(grid, p, [&](unsigned k) {
      if (static_cast<int>(k) == blocked || !d.holds(k, p, v, tol)) return true;
      found = static_cast<int>(k);
      return false;
    });
    return found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    walk_cells(
        grid, p, v, [&](unsigned k) { nearest(k); }, [&] { return smaller(limit, best); });
    return nearest.hit;
  }
};

/// The same with boxes around daughters, which are tested eight at once.
template <class Index>
struct SearchBoxes {
  BlockGrid<Index> grid;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    int found = -1;
    visit_blocks_at(grid, p, [&](unsigned k) {
      if (static_cast<int>(k) == blocked || !d.holds(k, p, v, tol)) return true;
      found = static_cast<int>(k);
      return false;
    });
    return found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    walk_blocks(
        grid, p, v, [&](unsigned k) { nearest(k); }, [&] { return smaller(limit, best); });
    return nearest.hit;
  }
};

/// The daughters that are not in the pattern of a search. A few are listed by number, others by
/// their boxes.
template <class Index>
struct Beside {
  const Index* few;
  unsigned few_count;
  const BoxBlock* blocks;
  const Index (*in_block)[box_lanes];
  unsigned block_count;

  template <class Visit>
  [[gnu::always_inline]] void at(const Vec3<double>& p, const Visit& visit) const {
    for (unsigned i = 0; i < few_count; ++i) visit(static_cast<unsigned>(few[i]));
    visit_blocks_around(blocks, in_block, block_count, p, visit);
  }
  template <class Visit, class Reach>
  [[gnu::always_inline]] void along(const Vec3<double>& p, const Direction<double>& v,
                                    const Visit& visit, const Reach& reach) const {
    for (unsigned i = 0; i < few_count; ++i) visit(static_cast<unsigned>(few[i]));
    if (block_count == 0) return;
    visit_blocks(blocks, in_block, 0, block_count, float_ray(p, v), 0, infinity<double>(), visit,
                 reach);
  }
};

/// Shells about an axis or, if `axis` is 3, about the centre.
template <class Index>
struct SearchNest {
  ShellNest<Index> shells;
  Beside<Index> beside;
  int axis;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    const auto visit = [&](unsigned k) { last(k); };
    beside.at(p, visit);
    const double x = along_axis(p, axis == 0   ? 1
                                   : axis == 1 ? 2
                                               : 0),
                 y = along_axis(p, axis == 0   ? 2
                                   : axis == 1 ? 0
                                               : 1);
    visit_shells_at(shells, axis == 3 ? p.x * p.x + p.y * p.y + p.z * p.z : x * x + y * y, visit);
    return last.found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    const auto visit = [&](unsigned k) { nearest(k); };
    const auto reach = [&] { return smaller(limit, best); };
    beside.along(p, v, visit, reach);
    const int i = axis == 0 ? 1 : axis == 1 ? 2 : 0, j = axis == 0 ? 2 : axis == 1 ? 0 : 1;
    const Vec3<double> along{v.x, v.y, v.z};
    double from = 0, to = infinity<double>();
    if (shells.ends) {
      clip_to_ends(shells.low, shells.high, along_axis(p, axis), along_axis(along, axis),
                   along_axis({v.inverse_x, v.inverse_y, v.inverse_z}, axis), from, to);
    }
    const RadialRay ray = axis == 3 ? about_centre(p, v)
                                    : about_axis(along_axis(p, i), along_axis(p, j),
                                                 along_axis(along, i), along_axis(along, j));
    walk_shells(shells, ray, from, to, visit, reach);
    return nearest.hit;
  }
};

/// Rings of daughters about an axis, one ring after the other.
template <class Index>
struct SearchRings {
  const RingSectors<Index>* rings;
  unsigned count;
  Beside<Index> beside;
  int axis;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    const auto visit = [&](unsigned k) { last(k); };
    beside.at(p, visit);
    const int i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
    for (unsigned n = 0; n < count; ++n) {
      visit_sector_at(rings[n], along_axis(p, i), along_axis(p, j), along_axis(p, axis), visit);
    }
    return last.found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    const auto visit = [&](unsigned k) { nearest(k); };
    const auto reach = [&] { return smaller(limit, best); };
    beside.along(p, v, visit, reach);
    const int i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
    const Vec3<double> u{v.x, v.y, v.z};
    const AxialRay ray{along_axis(p, i),
                       along_axis(p, j),
                       along_axis(p, axis),
                       along_axis(u, i),
                       along_axis(u, j),
                       along_axis(u, axis),
                       along_axis({v.inverse_x, v.inverse_y, v.inverse_z}, axis)};
    for (unsigned n = 0; n < count; ++n) walk_ring(rings[n], ray, visit, reach);
    return nearest.hit;
  }
};

/// Parallel wires in rows, which have a few directions.
template <class Index>
struct SearchWires {
  const WireBundle<Index>* bundles;
  unsigned count;
  Beside<Index> beside;
  const Index* others;  ///< the daughters beside the wires, by number
  unsigned other_count;
  const FloatBox* boxes;  ///< by daughter; null: the generic navigator answers for safety

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3<double>& p,
                                  const Direction<double>& v, int blocked, double tol) const {
    LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    const auto visit = [&](unsigned k) { last(k); };
    beside.at(p, visit);
    for (unsigned n = 0; n < count; ++n) visit_wires_at(bundles[n], p, visit);
    return last.found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3<double>& p,
                                     const Direction<double>& v, double& best, double limit,
                                     unsigned, double tol) const {
    NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    const auto visit = [&](unsigned k) { nearest(k); };
    const auto reach = [&] { return smaller(limit, best); };
    beside.along(p, v, visit, reach);
    for (unsigned n = 0; n < count; ++n) walk_wires(bundles[n], p, v, visit, reach);
    return nearest.hit;
  }
  /// The smallest of `safety` and the safeties of the daughters. As in the generic navigator, that
  /// of a daughter is no less than the distance to its box.
  template <class Daughters>
  [[gnu::always_inline]] double safety_among(const Daughters& d, const Vec3<double>& p,
                                             double safety) const {
    const BoxDistance from(p);
    const auto ask = [&](unsigned k, double least) {
      const double bound = from(boxes[k]);
      return bound < least ? smaller(larger(d.away(k, p), bound), least) : least;
    };
    for (unsigned n = 0; n < count; ++n) safety = safety_among_wires(bundles[n], p, safety, ask);
    for (unsigned i = 0; i < other_count; ++i) {
      safety = ask(static_cast<unsigned>(others[i]), safety);
    }
    return safety;
  }
};

}  // namespace navjit::kernels
