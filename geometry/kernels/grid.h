// A scene that is partitioned into cells, which are walked along a ray or looked up at a point. The
// search only finds candidates: it may offer daughters that are not hit, but never leaves one out
// that is. For this, daughters are listed in cells with a margin far above the rounding of a
// position.
namespace navjit::kernels {

template <class Index>
struct CellGrid {
  int count[3];
  double origin[3], width[3], per_mm[3];  ///< per_mm = 1 / width
  const unsigned* first;                  ///< by cell: start in members
  const Index* members;                   ///< daughters, ascending within a cell
};

/// The cell along one axis, clamped: the outermost cells reach to infinity.
inline int cell_along(double p, double origin, double per_mm, int count) {
  if (count == 1) return 0;
  const double i = smaller(larger((p - origin) * per_mm, 0.0), static_cast<double>(count - 1));
  return static_cast<int>(i);
}

template <class Grid>
inline unsigned cell_of(const Grid& g, int i, int j, int k) {
  return static_cast<unsigned>((i * g.count[1] + j) * g.count[2] + k);
}

template <class Grid>
inline unsigned cell_at(const Grid& g, const Vec3<double>& p) {
  return cell_of(g, cell_along(p.x, g.origin[0], g.per_mm[0], g.count[0]),
                 cell_along(p.y, g.origin[1], g.per_mm[1], g.count[1]),
                 cell_along(p.z, g.origin[2], g.per_mm[2], g.count[2]));
}

/// Calls visit(daughter) for the daughters in the point's cell, in descending file order, until
/// visit returns false.
template <class Index, class Visit>
inline void visit_cell_at(const CellGrid<Index>& g, const Vec3<double>& p, const Visit& visit) {
  const unsigned b = cell_at(g, p);
  for (unsigned m = g.first[b + 1]; m-- > g.first[b];) {
    if (!visit(static_cast<unsigned>(g.members[m]))) return;
  }
}

/// One axis of a walk: the present cell and the path length at which the ray leaves it.
struct GridAxis {
  int index, step, end;
  double leave;
};

inline double cell_edge(double p, double v, double inverse, double origin, double width,
                        int index) {
  const int edge = v < 0 ? index : index + 1;
  // A ray along the edge never crosses it. The product would be 0 times infinity, which is NaN, if
  // the ray were on the edge.
  if (!(absolute(inverse) < infinity<double>())) return infinity<double>();
  return (origin + edge * width - p) * inverse;
}

inline GridAxis grid_axis(double p, double v, double inverse, double origin, double width,
                          int count, int index) {
  if (count == 1) return {0, 0, 0, infinity<double>()};
  return {index, v < 0 ? -1 : 1, v < 0 ? -1 : count,
          cell_edge(p, v, inverse, origin, width, index)};
}

/// Goes to the next cell along one axis. The outermost cells reach to infinity, because a ray along
/// the scene's own face may leave the grid by a rounding error and still meet daughters that have
/// the same face.
inline void next_cell(GridAxis& a, double p, double v, double inverse, double origin,
                      double width) {
  if (a.index + a.step == a.end) {
    a.leave = infinity<double>();
  } else {
    a.index += a.step;
    a.leave = cell_edge(p, v, inverse, origin, width, a.index);
  }
}

/// Calls visit(cell, from, to) for the cells along the ray, with the path lengths between which the
/// ray is in the cell, until it has passed `reach()`, a path length that visits may shorten. The
/// last `to` is infinite. The contents of cell b are listed from first[b] to first[b + 1].
template <class Grid, class Visit, class Reach>
inline void walk_grid(const Grid& g, const Vec3<double>& p, const Direction<double>& v,
                      const Visit& visit, const Reach& reach) {
  const int i = cell_along(p.x, g.origin[0], g.per_mm[0], g.count[0]);
  const int j = cell_along(p.y, g.origin[1], g.per_mm[1], g.count[1]);
  const int k = cell_along(p.z, g.origin[2], g.per_mm[2], g.count[2]);
  GridAxis x{i, 0, 0, infinity<double>()}, y{j, 0, 0, infinity<double>()},
      z{k, 0, 0, infinity<double>()};
  // Many rays end in the cell where they begin.
  const double far = reach();
  const bool ends_here =
      (far < 1e30) && ((cell_along(p.x + far * v.x, g.origin[0], g.per_mm[0], g.count[0]) == i) &
                       (cell_along(p.y + far * v.y, g.origin[1], g.per_mm[1], g.count[1]) == j) &
                       (cell_along(p.z + far * v.z, g.origin[2], g.per_mm[2], g.count[2]) == k));
  if (ends_here) {
    // An empty cell is recognised before the work that all visits share.
    const unsigned b = cell_of(g, i, j, k);
    if (g.first[b] == g.first[b + 1]) return;
  } else {
    x = grid_axis(p.x, v.x, v.inverse_x, g.origin[0], g.width[0], g.count[0], i);
    y = grid_axis(p.y, v.y, v.inverse_y, g.origin[1], g.width[1], g.count[1], j);
    z = grid_axis(p.z, v.z, v.inverse_z, g.origin[2], g.width[2], g.count[2], k);
  }
  for (double from = 0;;) {
    const double leave = smaller(x.leave, smaller(y.leave, z.leave));
    visit(cell_of(g, x.index, y.index, z.index), from, leave);
    if (!(leave < reach())) return;
    from = leave;
    if (leave == x.leave) {
      next_cell(x, p.x, v.x, v.inverse_x, g.origin[0], g.width[0]);
    } else if (leave == y.leave) {
      next_cell(y, p.y, v.y, v.inverse_y, g.origin[1], g.width[1]);
    } else {
      next_cell(z, p.z, v.z, v.inverse_z, g.origin[2], g.width[2]);
    }
  }
}

/// Calls visit(daughter) for the daughters in the cells along the ray, until the ray has passed
/// `reach()`.
template <class Index, class Visit, class Reach>
inline void walk_cells(const CellGrid<Index>& g, const Vec3<double>& p, const Direction<double>& v,
                       const Visit& visit, const Reach& reach) {
  walk_grid(
      g, p, v,
      [&](unsigned b, double, double) {
        for (unsigned m = g.first[b]; m < g.first[b + 1]; ++m) {
          visit(static_cast<unsigned>(g.members[m]));
        }
      },
      reach);
}

/// Whether the point is in the box, which must include a margin.
inline bool is_in_box(const Vec3<double>& low, const Vec3<double>& high, const Vec3<double>& p) {
  return (p.x >= low.x) & (p.x <= high.x) & (p.y >= low.y) & (p.y <= high.y) & (p.z >= low.z) &
         (p.z <= high.z);
}

/// Whether the ray may meet the box within [0, reach]. The box must include a margin.
inline bool may_meet_box(const Vec3<double>& low, const Vec3<double>& high, const Vec3<double>& p,
                         const Direction<double>& v, double reach) {
  double enter = 0, leave = reach;
  const double x0 = (low.x - p.x) * v.inverse_x, x1 = (high.x - p.x) * v.inverse_x;
  const double y0 = (low.y - p.y) * v.inverse_y, y1 = (high.y - p.y) * v.inverse_y;
  const double z0 = (low.z - p.z) * v.inverse_z, z1 = (high.z - p.z) * v.inverse_z;
  enter = larger(v.x < 0 ? x1 : x0, enter);
  leave = smaller(v.x < 0 ? x0 : x1, leave);
  enter = larger(v.y < 0 ? y1 : y0, enter);
  leave = smaller(v.y < 0 ? y0 : y1, leave);
  enter = larger(v.z < 0 ? z1 : z0, enter);
  leave = smaller(v.z < 0 ? z0 : z1, leave);
  return enter <= leave;
}

}  // namespace navjit::kernels
