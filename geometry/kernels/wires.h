// Parallel wires (tubes, bars, fibres) side by side, in one row or in a few above one another, at
// any angle to the mother's axes. Seen along the wires, a ray passes a row of discs. The discs that
// it comes near to are in an interval of the row, which usually has one wire or none. The search
// only finds candidates. Discs include a margin far above the rounding of a position and above the
// deviation of their middles from the row.
namespace navjit::kernels {

/// Coordinates across the wires are u along the row and n along the row's normal.
template <class Index>
struct WireRow {
  double at;              ///< n of the row's middle, mm
  double half_u, half_n;  ///< a rectangle that holds every wire of the row about its place, mm
  double radius;          ///< a circle that holds every wire about its place, mm
  int count;
  const double* u;        ///< of the wires' middles, ascending, mm
  const Index* daughter;  ///< by position
  double origin, per_mm;  ///< cells along the row
  int cells;
  /// By cell, with one entry more than cells: the first position whose middle is in that cell or
  /// beyond it.
  const Index* first;
};

/// Wires of one direction.
template <class Index>
struct WireBundle {
  double across[3], normal[3], along[3];  ///< unit vectors of u, n, and of the wires
  unsigned count;
  const WireRow<Index>* rows;  ///< ascending in n; they may overlap
  bool ends;                   ///< whether rays come beyond the ends of all wires
  double low, high;            ///< these ends, along the wires, with a margin, mm
  /// Whether the safety_to_in of every wire is at least the distance from its circle. If not, it is
  /// at least the distance from its rectangle, along u or n, whichever is larger.
  bool round;
};

inline double dot_row(const double (&a)[3], double x, double y, double z) {
  return a[0] * x + a[1] * y + a[2] * z;
}

/// The first position in the cell of `u` or beyond this cell. No earlier position is at `u` or
/// beyond it.
template <class Index>
inline int first_wire_from(const WireRow<Index>& row, double u) {
  return static_cast<int>(row.first[cell_along(u, row.origin, row.per_mm, row.cells)]);
}

/// A ray seen along the wires.
struct RayAcross {
  double u, n, vu, vn;
  bool flat;  ///< whether it runs along the row, to within the margin over a path as long as the
              ///< scene
  double inverse;  ///< 1 / vn; 0 if flat
  double slope;    ///< how far it moves along the row for each mm across the row, >= 0
  double norm;     ///< the length of (1, slope), or up to 9% more
};

template <class Index>
inline RayAcross ray_across(const WireBundle<Index>& b, const Vec3<double>& p,
                            const Direction<double>& v) {
  RayAcross ray;
  ray.u = dot_row(b.across, p.x, p.y, p.z);
  ray.n = dot_row(b.normal, p.x, p.y, p.z);
  ray.vu = dot_row(b.across, v.x, v.y, v.z);
  ray.vn = dot_row(b.normal, v.x, v.y, v.z);
  ray.flat = !(absolute(ray.vn) > 1e-12);
  ray.inverse = ray.flat ? 0.0 : 1 / ray.vn;
  ray.slope = absolute(ray.vu * ray.inverse);
  ray.norm = larger(ray.slope, 1.0) + 0.4142135624 * smaller(ray.slope, 1.0);
  return ray;
}

/// Calls visit(daughter) for the wires of one row that the ray may meet between the path lengths
/// `from` and `end()`, which visits may shorten, in the order of their places along the ray.
template <class Index, class Visit, class End>
inline void walk_wire_row(const WireRow<Index>& row, const RayAcross& ray, double from,
                          const Visit& visit, End end) {
  const double dn = row.at - ray.n;
  double to = end(), low, high;
  if (ray.flat) {
    if (absolute(dn) > row.half_n) return;
    low = smaller(ray.u + from * ray.vu, ray.u + to * ray.vu) - row.half_u;
    high = larger(ray.u + from * ray.vu, ray.u + to * ray.vu) + row.half_u;
  } else {
    // The part of the ray within the thickness of the row.
    const double at = dn * ray.inverse, thick = row.half_n * absolute(ray.inverse);
    if (at + thick < from || at - thick > to) return;
    const double u0 = ray.u + larger(at - thick, from) * ray.vu,
                 u1 = ray.u + smaller(at + thick, to) * ray.vu;
    // The line passes the middle of a disc that it meets within the radius, and the middle of a
    // rectangle within the distance of the corners.
    const double middle = ray.u + at * ray.vu;
    const double reach = smaller(row.radius * ray.norm, row.half_u + row.half_n * ray.slope);
    low = larger(smaller(u0, u1) - row.half_u, middle - reach);
    high = smaller(larger(u0, u1) + row.half_u, middle + reach);
  }
  if (!(low <= high)) return;
  if (ray.vu < 0) {
    const int cell = cell_along(high, row.origin, row.per_mm, row.cells);
    for (int i = static_cast<int>(row.first[cell + 1]) - 1; i >= 0 && row.u[i] >= low; --i) {
      if (row.u[i] > high) continue;
      visit(static_cast<unsigned>(row.daughter[i]));
      low = larger(ray.u + end() * ray.vu - row.half_u, low);
    }
    return;
  }
  for (int i = first_wire_from(row, low); i < row.count && row.u[i] <= high; ++i) {
    if (row.u[i] < low) continue;
    visit(static_cast<unsigned>(row.daughter[i]));
    high = smaller(ray.u + end() * ray.vu + row.half_u, high);
  }
}

/// Calls visit(daughter) for the wires that the ray may meet within `reach()`, a path length that
/// visits may shorten, row by row in the order in which the ray comes to them.
template <class Index, class Visit, class Reach>
inline void walk_wires(const WireBundle<Index>& b, const Vec3<double>& p,
                       const Direction<double>& v, const Visit& visit, const Reach& reach) {
  double from = 0, to = 1e30;
  if (b.ends) {
    const double along = dot_row(b.along, v.x, v.y, v.z) + 0.0;
    clip_to_ends(b.low, b.high, dot_row(b.along, p.x, p.y, p.z), along, 1 / along, from, to);
    if (from > to) return;
  }
  const RayAcross ray = ray_across(b, p, v);
  for (unsigned m = 0; m < b.count; ++m) {
    walk_wire_row(b.rows[ray.vn < 0 ? b.count - 1 - m : m], ray, from, visit,
                  [&] { return smaller(reach(), to); });
  }
}

/// Calls visit(daughter) for the wires that may hold the point.
template <class Index, class Visit>
inline void visit_wires_at(const WireBundle<Index>& b, const Vec3<double>& p, const Visit& visit) {
  const double u = dot_row(b.across, p.x, p.y, p.z), n = dot_row(b.normal, p.x, p.y, p.z);
  for (unsigned m = 0; m < b.count; ++m) {
    const WireRow<Index>& row = b.rows[m];
    if (absolute(row.at - n) > row.half_n) continue;
    const double low = u - row.half_u, high = u + row.half_u;
    for (int i = first_wire_from(row, low); i < row.count && row.u[i] <= high; ++i) {
      if (row.u[i] >= low) visit(static_cast<unsigned>(row.daughter[i]));
    }
  }
}

/// The smallest of `safety` and ask(daughter, safety) for all wires. Wires that are farther away
/// are not asked.
template <class Index, class Ask>
inline double safety_among_wires(const WireBundle<Index>& b, const Vec3<double>& p, double safety,
                                 const Ask& ask) {
  const double u = dot_row(b.across, p.x, p.y, p.z), n = dot_row(b.normal, p.x, p.y, p.z);
  for (unsigned m = 0; m < b.count; ++m) {
    const WireRow<Index>& row = b.rows[m];
    const double dn = absolute(row.at - n);
    if (dn - row.half_n > safety) continue;
    // Asks a wire unless it is too far away. Returns false if the wires beyond it are too far away
    // as well.
    const auto nearest = [&](int i, double du) {
      if (du - row.half_u > safety) return false;
      const double far = safety + row.radius;
      if (!(b.round && du * du + dn * dn > far * far)) {
        safety = ask(static_cast<unsigned>(row.daughter[i]), safety);
      }
      return true;
    };
    const int start = first_wire_from(row, u);
    for (int i = start; i < row.count && nearest(i, row.u[i] - u); ++i) {
    }
    for (int i = start - 1; i >= 0 && nearest(i, u - row.u[i]); --i) {
    }
  }
  return safety;
}

/// The box around a daughter, as in the generic navigator, mm.
struct FloatBox {
  float low[3], high[3];
};

/// A point's distance from a box, mm, with the same bits as in the generic navigator
/// (BoxDistances).
struct BoxDistance {
  float below[3], above[3];

  explicit BoxDistance(const Vec3<double>& p)
      : below{strictly_below(p.x), strictly_below(p.y), strictly_below(p.z)},
        above{strictly_above(p.x), strictly_above(p.y), strictly_above(p.z)} {}

  double operator()(const FloatBox& box) const {
    float square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float outside =
          larger(larger(box.low[axis] - above[axis], below[axis] - box.high[axis]), 0.0f);
      square += outside * outside;
    }
    square = smaller(square, __FLT_MAX__);
    return static_cast<double>(square_root(square) * (1 - 0x1p-21f));
  }
};

}  // namespace navjit::kernels
