// Daughters that follow one another along an axis without overlapping. The search only finds
// candidates. Its margins are such that it never misses one.
namespace navjit::kernels {

/// A slab's position is its number along the axis. `low` and `high` include the margin.
template <class Index>
struct SlabRow {
  int count;
  const double *low, *high;  ///< mm, by position
  const Index* daughter;     ///< by position
  const Index* position;     ///< by daughter
  /// A track that came out of a slab does not meet it again if it is no deeper than this within
  /// `low` or `high`, mm. It is the margin and half the tolerance; 0 if that is not known.
  double skin;
  double origin, per_mm;
  int cells;
  /// By cell: the first position that an ascending ray from there may meet, and the last position
  /// for a descending ray.
  const Index *ascending, *descending;
};

/// The first position that the ray may meet. `left` is the daughter that the track may have left
/// last, or any number. If that daughter is just behind the ray, the answer is the next position,
/// which the processor knows before it has the point. `oblique`: the ray is known not to run along
/// the slabs.
template <bool oblique, class Index>
inline int first_slab(const SlabRow<Index>& s, double p, double v, unsigned left) {
  const bool down = v < 0;
  if (s.skin > 0 && left < static_cast<unsigned>(s.count) && (oblique || !is_nearly_across(v))) {
    const int at = static_cast<int>(s.position[left]), next = down ? at - 1 : at + 1;
    const bool behind = down ? p <= s.low[at] + s.skin : p >= s.high[at] - s.skin;
    const bool ends = static_cast<unsigned>(next) >= static_cast<unsigned>(s.count);
    if (behind && (ends || (down ? p >= s.low[next] : p <= s.high[next]))) return next;
  }
  const int b = cell_along(p, s.origin, s.per_mm, s.cells);
  return static_cast<int>((down ? s.descending : s.ascending)[b]);
}

/// One beyond the last position along the ray.
template <class Index>
inline int end_of_slabs(const SlabRow<Index>& s, double v) {
  return v < 0 ? -1 : s.count;
}

/// Whether the slab begins beyond `reach`, a path length. The comparison is with NaN, and so false,
/// where the ray runs exactly along the edge of the margin; the slab is then offered.
template <class Index>
inline bool slab_is_beyond(const SlabRow<Index>& s, int i, double p, double v, double inverse,
                           double reach) {
  return ((v < 0 ? s.high : s.low)[i] - p) * inverse > reach;
}

/// Calls visit(daughter), which returns whether the ray meets the daughter, for daughters along the
/// ray from position `i` on until one is met or the next is beyond `reach`. `p`, `v` and `inverse`
/// are the ray's along the axis. The first daughter that is met is the nearest, because the next
/// one begins where it ends. But a ray along the slabs, or nearly so, may run where two daughters
/// touch or overlap within the tolerance, and then both are offered.
template <class Index, class Visit>
inline void walk_slabs_from(const SlabRow<Index>& s, int i, double p, double v, double inverse,
                            double reach, const Visit& visit) {
  const int last = end_of_slabs(s, v), next = v < 0 ? -1 : 1;
  for (; i != last; i += next) {
    if (slab_is_beyond(s, i, p, v, inverse, reach)) return;
    if (visit(static_cast<unsigned>(s.daughter[i])) && !is_nearly_across(v)) return;
  }
}

/// The same from the first position on. For `left` see first_slab.
template <class Index, class Visit>
inline void walk_slabs(const SlabRow<Index>& s, double p, double v, double inverse, double reach,
                       unsigned left, const Visit& visit) {
  walk_slabs_from(s, first_slab<false>(s, p, v, left), p, v, inverse, reach, visit);
}

/// Calls visit(daughter) for the daughters that may hold the point.
template <class Index, class Visit>
inline void visit_slabs_at(const SlabRow<Index>& s, double p, const Visit& visit) {
  const int b = cell_along(p, s.origin, s.per_mm, s.cells);
  for (int i = static_cast<int>(s.ascending[b]); i < s.count && s.low[i] <= p; ++i) {
    visit(static_cast<unsigned>(s.daughter[i]));
  }
}

}  // namespace navjit::kernels
