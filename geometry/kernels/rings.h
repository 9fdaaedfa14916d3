// Daughters at equal steps of azimuth about an axis. A ray passes sectors one after the other, from
// the one that it starts in to the one that it ends in, which is less than half a turn away. The
// search only finds candidates. Near an edge the sector beyond the edge counts, too. What is near
// is far larger than the rounding of positions, and no sector is so narrow that this would include
// more than its neighbour.
//
// If daughters lean, sectors end at tangents of a circle about the axis, and the direction of the
// tangent through a point takes the place of the azimuth. Outside of the circle a ray turns from
// tangent to tangent as it does from azimuth to azimuth: in one sense and by less than half a turn.
// Its sense can change only on the circle itself.
namespace navjit::kernels {

/// Here x and y are the coordinates across the axis, and z is the one along it.
template <class Index>
struct RingSectors {
  double near2, far2, low, high;  ///< squared radii and ends, with a margin, mm^2 and mm
  bool hole, outside, ends;       ///< whether rays may come nearer, or farther, or beyond the ends
  int sectors;
  const double (*edges)[2];  ///< unit vectors along the lower edges of sectors, and the first again
  const Index* at_angle;     ///< by cell of square_angle: the sector that the cell begins in
  double cells_per_angle;
  int cells;
  double reach;  ///< mm; within this of an edge the sector beyond the edge counts, too
  /// The edges are tangents of a circle of this radius, mm, about the axis; all daughters are
  /// outside of the circle. Seen outwards, the edges have the axis on their right, or on their left
  /// if `lean` is negative. If it is 0, the edges are radii.
  double lean;
  const unsigned* first;  ///< by sector: start in members
  const Index* members;   ///< daughters, ascending within a sector
};

/// A measure of azimuth in [0, 4], ascending from the x axis on: where a ray from the axis meets a
/// square around it.
inline double square_angle(double x, double y) {
  const double d = y / (absolute(x) + absolute(y));
  return x < 0 ? 2 - d : y < 0 ? 4 + d : d;
}

/// The length of the tangent from a point to the circle; 0 for a point within the circle. Without a
/// circle (`lean` 0) it is the point's distance from the axis.
template <class Index>
inline double tangent_length(const RingSectors<Index>& g, double x, double y) {
  return square_root(larger(x * x + y * y - g.lean * g.lean, 0.0));
}

/// How far a point is beyond a sector's edge, mm.
template <class Index>
inline double beyond_edge(const RingSectors<Index>& g, int edge, double x, double y) {
  return g.edges[edge][0] * y - g.edges[edge][1] * x - g.lean;
}

/// The sector of a point. For a point on the axis or within the circle it is an arbitrary one. A
/// cell contains at most one edge.
template <class Index>
inline int sector_at(const RingSectors<Index>& g, double x, double y) {
  double along_x = x, along_y = y;
  if (g.lean != 0) {
    const double h = tangent_length(g, x, y);
    along_x = h * x + g.lean * y;
    along_y = h * y - g.lean * x;
  }
  const double cell = smaller(larger(square_angle(along_x, along_y) * g.cells_per_angle, 0.0),
                              static_cast<double>(g.cells - 1));
  const int sector = static_cast<int>(g.at_angle[static_cast<int>(cell)]);
  const int next = sector + 1 == g.sectors ? 0 : sector + 1;
  // Directions of tangents are compared, since the distance from an edge has the sign of the angle
  // only near it, if sectors are wide and daughters lean.
  const double turn = g.edges[sector + 1][0] * along_y - g.edges[sector + 1][1] * along_x;
  return turn >= 0 ? next : sector;
}

template <class Index>
inline int sector_beside(const RingSectors<Index>& g, int sector, bool upper) {
  return upper ? (sector + 1 == g.sectors ? 0 : sector + 1)
               : (sector == 0 ? g.sectors - 1 : sector - 1);
}

/// Whether a point of the sector is near the sector's upper edge, or its lower edge if not `upper`.
template <class Index>
inline bool is_near_edge(const RingSectors<Index>& g, int sector, bool upper, double x, double y) {
  return absolute(beyond_edge(g, upper ? sector + 1 : sector, x, y)) <= g.reach;
}

/// Calls visit(daughter) for the daughters that may hold a point.
template <class Index, class Visit>
inline void visit_sector_at(const RingSectors<Index>& g, double x, double y, double z,
                            const Visit& visit) {
  const double r2 = x * x + y * y;
  if ((r2 < g.near2) | (r2 > g.far2) | (z < g.low) | (z > g.high)) return;
  const int at = sector_at(g, x, y);
  const auto all = [&](int sector) {
    for (unsigned m = g.first[sector]; m < g.first[sector + 1]; ++m) {
      visit(static_cast<unsigned>(g.members[m]));
    }
  };
  all(at);
  if (is_near_edge(g, at, false, x, y)) all(sector_beside(g, at, false));
  if (is_near_edge(g, at, true, x, y)) all(sector_beside(g, at, true));
}

/// A ray in the coordinates of the ring.
struct AxialRay {
  double x, y, z, vx, vy, vz, inverse_z;
};

/// The path lengths at which a ray is in a ring: from `from` to `to`, except between `enter` and
/// `leave`, where it is in the hole.
struct RingPart {
  double from, to, enter, leave;
};

template <class Index>
inline RingPart ring_part(const RingSectors<Index>& g, const AxialRay& ray, double reach) {
  RingPart part{0, reach, infinity<double>(), infinity<double>()};
  constexpr RingPart none{1, 0, 0, 0};
  if (g.ends) {
    clip_to_ends(g.low, g.high, ray.z, ray.vz, ray.inverse_z, part.from, part.to);
  }
  if (!g.hole && !g.outside) return part;
  const double a = ray.vx * ray.vx + ray.vy * ray.vy, b = ray.x * ray.vx + ray.y * ray.vy;
  const double r2 = ray.x * ray.x + ray.y * ray.y;
  if (a < 1e-20) {  // a ray along the axis keeps its radius for as long as any scene is
    return ((r2 < g.near2) | (r2 > g.far2)) ? none : part;
  }
  const double inverse = 1 / a;
  if (g.outside) {
    const double discriminant = b * b - a * (r2 - g.far2);
    if (discriminant < 0) return none;
    const double root = square_root(discriminant);
    part.from = larger((-b - root) * inverse, part.from);
    part.to = smaller((-b + root) * inverse, part.to);
  }
  if (g.hole) {
    const double discriminant = b * b - a * (r2 - g.near2);
    if (discriminant > 0) {
      const double root = square_root(discriminant);
      part.enter = (-b - root) * inverse;
      part.leave = (-b + root) * inverse;
      if (!(part.leave > part.from)) part.enter = part.leave = infinity<double>();
      if (part.enter < part.from) {
        part.from = part.leave;
        part.enter = part.leave = infinity<double>();
      }
    }
  }
  return part;
}

/// Whether a ray that is at (x, y) goes on to higher sectors from there.
template <class Index>
inline bool goes_up(const RingSectors<Index>& g, const AxialRay& ray, double x, double y) {
  const double turns = ray.x * ray.vy - ray.y * ray.vx;
  if (g.lean == 0) return turns >= 0;
  return tangent_length(g, x, y) * turns + g.lean * (x * ray.vx + y * ray.vy) >= 0;
}

/// Calls visit(daughter) for the daughters whose sectors the ray passes within `reach()`, a path
/// length that visits may shorten.
template <class Index, class Visit, class Reach>
inline void walk_ring(const RingSectors<Index>& g, const AxialRay& ray, const Visit& visit,
                      const Reach& reach) {
  RingPart part = ring_part(g, ray, reach());
  while (!(part.from > part.to)) {
    const double x = ray.x + part.from * ray.vx, y = ray.y + part.from * ray.vy;
    const int start = sector_at(g, x, y);
    const bool up = goes_up(g, ray, x, y);
    const double stop = smaller(part.enter, part.to);
    double end = infinity<double>(), ex = 0, ey = 0;
    int last = 0, steps = 0;
    int sector = start, beside = 0;
    for (int i = 0;;) {
      // Whenever visits have shortened the reach, the end of this part is found anew.
      if (const double now = smaller(reach(), stop); beside == 0 && (i == 0 || now < end)) {
        end = now;
        ex = ray.x + end * ray.vx;
        ey = ray.y + end * ray.vy;
        last = sector_at(g, ex, ey);
        steps = up ? last - start : start - last;
        if (steps < 0) steps += g.sectors;
        // A ray turns by less than half a turn. If there are more steps, something was rounded or
        // is not a number.
        if (2 * steps > g.sectors + 2 || !(absolute(ex) + absolute(ey) < 1e30)) {
          steps = g.sectors - 1;
        }
      }
      if (i > steps) {
        // Then the sectors just across an edge from where the part begins and ends.
        bool near = false;
        for (; !near && beside < 4; ++beside) {
          const bool upper = beside % 2 == 1, at_end = beside >= 2;
          near = is_near_edge(g, at_end ? last : start, upper, at_end ? ex : x, at_end ? ey : y);
          if (near) sector = sector_beside(g, at_end ? last : start, upper);
        }
        if (!near) break;
      }
      for (unsigned m = g.first[sector]; m < g.first[sector + 1]; ++m) {
        visit(static_cast<unsigned>(g.members[m]));
      }
      ++i;
      sector = sector_beside(g, sector, up);
    }
    // The loop runs at most twice, since there is one hole.
    if (part.leave == infinity<double>() || part.leave > smaller(reach(), part.to)) return;
    part.from = part.leave;
    part.enter = part.leave = infinity<double>();
  }
}

}  // namespace navjit::kernels
