// Daughters at equal steps of azimuth about an axis: a ray passes sectors one after the other, from
// the one it starts in to the one it ends in, less than half a turn on. Only a filter: near an edge
// the sector beyond it counts, too, by far more than positions are rounded by, and no sector is so
// narrow that this would be more than its neighbour.
//
// Daughters may lean: sectors then end at tangents of a circle about the axis, and the direction of
// the tangent that a point is on stands for its azimuth. Outside of the circle a ray turns from
// tangent to tangent as it does from azimuth to azimuth, one way and by less than half a turn: only
// on the circle itself its sense may change.
namespace navjit::kernels {

/// Coordinates across the axis are x and y here, along it z.
template <class Index>
struct RingSectors {
  double near2, far2, low, high;  ///< squared radii and ends, with a margin, mm^2 and mm
  bool hole, outside, ends;       ///< whether rays come nearer, farther, beyond the ends
  int sectors;
  const double (*edges)[2];  ///< unit vectors along the lower edges of sectors, and the first again
  const Index* at_angle;     ///< by cell of square_angle: the sector of its beginning
  double cells_per_angle;
  int cells;
  double reach;  ///< so near to an edge the sector beyond it counts, too, mm
  /// The radius, mm, of a circle about the axis, within all daughters, whose tangents the edges
  /// are. Seen outwards they have the axis on their right; on their left where this is negative. 0:
  /// the edges are radii.
  double lean;
  const unsigned* first;  ///< by sector: start in members
  const Index* members;   ///< daughters, ascending within a sector
};

/// In [0, 4], ascending with the azimuth from the x axis on: where a ray from the axis meets a
/// square.
inline double square_angle(double x, double y) {
  const double d = y / (absolute(x) + absolute(y));
  return x < 0 ? 2 - d : y < 0 ? 4 + d : d;
}

/// The length of the tangent from a point to the circle; its radius where there is none.
template <class Index>
inline double tangent_length(const RingSectors<Index>& g, double x, double y) {
  return square_root(larger(x * x + y * y - g.lean * g.lean, 0.0));
}

/// How far a point is beyond a sector's edge, mm.
template <class Index>
inline double beyond_edge(const RingSectors<Index>& g, int edge, double x, double y) {
  return g.edges[edge][0] * y - g.edges[edge][1] * x - g.lean;
}

/// The sector of a point; any where the point is on the axis, or within the circle. A cell has an
/// edge at most.
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
  return beyond_edge(g, sector + 1, x, y) >= 0 ? next : sector;
}

template <class Index>
inline int sector_beside(const RingSectors<Index>& g, int sector, bool upper) {
  return upper ? (sector + 1 == g.sectors ? 0 : sector + 1)
               : (sector == 0 ? g.sectors - 1 : sector - 1);
}

/// Whether a point of the sector is near its upper or its lower edge.
template <class Index>
inline bool is_near_edge(const RingSectors<Index>& g, int sector, bool upper, double x, double y) {
  return absolute(beyond_edge(g, upper ? sector + 1 : sector, x, y)) <= g.reach;
}

/// Calls visit(daughter) for those that may hold a point.
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

/// A ray about the ring's axis.
struct AxialRay {
  double x, y, z, vx, vy, vz, inverse_z;
};

/// Where a ray is in a ring: [from, to] but for (enter, leave), path lengths.
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
  if (a < 1e-20) {  // along the axis: at its radius for as long as any scene is
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

/// Whether a ray that is at (x, y) goes to higher sectors from there.
template <class Index>
inline bool goes_up(const RingSectors<Index>& g, const AxialRay& ray, double x, double y) {
  const double turns = ray.x * ray.vy - ray.y * ray.vx;
  if (g.lean == 0) return turns >= 0;
  return tangent_length(g, x, y) * turns + g.lean * (x * ray.vx + y * ray.vy) >= 0;
}

/// Calls visit(daughter) for those whose sectors the ray passes within `reach()`, a path length
/// that visits may shorten.
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
      // Whenever the part becomes shorter, where it ends is found anew.
      if (const double now = smaller(reach(), stop); beside == 0 && (i == 0 || now < end)) {
        end = now;
        ex = ray.x + end * ray.vx;
        ey = ray.y + end * ray.vy;
        last = sector_at(g, ex, ey);
        steps = up ? last - start : start - last;
        if (steps < 0) steps += g.sectors;
        // Less than half a turn, unless it is rounded, or not a number.
        if (2 * steps > g.sectors + 2 || !(absolute(ex) + absolute(ey) < 1e30)) {
          steps = g.sectors - 1;
        }
      }
      if (i > steps) {
        // What is just across an edge from where the part begins or ends.
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
    // No more than twice, as there is one hole.
    if (part.leave == infinity<double>() || part.leave > smaller(reach(), part.to)) return;
    part.from = part.leave;
    part.enter = part.leave = infinity<double>();
  }
}

}  // namespace navjit::kernels
