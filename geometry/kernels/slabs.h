// Daughters that follow one another along an axis without overlapping. Only a filter, as cells are:
// margins make it conservative.
namespace navjit::kernels {

/// Positions count along the axis; `low` and `high` carry the margin.
template <class Index>
struct SlabRow {
  int count;
  const double *low, *high;  ///< mm, by position
  const Index* daughter;     ///< by position
  const Index* position;     ///< by daughter
  /// From a face of the margin to where a track that left there meets the slab no more, mm: the
  /// margin and half the tolerance. 0 where that is not known.
  double skin;
  double origin, per_mm;
  int cells;
  /// By cell: the first position that a ray ascending from there may meet; the last one for rays
  /// that descend.
  const Index *ascending, *descending;
};

/// The first position that the ray may meet. `left`: the daughter that the track may have left
/// last, or any number. If it is just behind, the next one follows, and that is known before the
/// point is. `oblique`: the ray is known not to run along the slabs.
template <bool oblique, class Index>
inline int first_slab(const SlabRow<Index>& s, double p, double v, unsigned left) {
  const bool down = v < 0;
  if (s.skin > 0 && left < static_cast<unsigned>(s.count) && (oblique || !is_along(v))) {
    const int at = static_cast<int>(s.position[left]), next = down ? at - 1 : at + 1;
    const bool behind = down ? p <= s.low[at] + s.skin : p >= s.high[at] - s.skin;
    const bool ends = static_cast<unsigned>(next) >= static_cast<unsigned>(s.count);
    if (behind && (ends || (down ? p >= s.low[next] : p <= s.high[next]))) return next;
  }
  const int b = cell_along(p, s.origin, s.per_mm, s.cells);
  return static_cast<int>((down ? s.descending : s.ascending)[b]);
}

/// Where positions along the ray end.
template <class Index>
inline int end_of_slabs(const SlabRow<Index>& s, double v) {
  return v < 0 ? -1 : s.count;
}

/// Whether the slab begins beyond `reach`, a path length. Not a number where the ray runs along
/// the very edge of the margin: then it is offered.
template <class Index>
inline bool slab_is_beyond(const SlabRow<Index>& s, int i, double p, double v, double inverse,
                           double reach) {
  return ((v < 0 ? s.high : s.low)[i] - p) * inverse > reach;
}

/// Calls visit(daughter), which says whether the ray meets it, for daughters along the ray from
/// position `i` on until one is met or the next is beyond `reach`. `p`, `v` and `inverse` are the
/// ray's along the axis. What the ray meets first is what is nearest, as those behind begin where
/// it ends; but a ray along the faces may be on one that two share, and then both are offered.
template <class Index, class Visit>
inline void walk_slabs_from(const SlabRow<Index>& s, int i, double p, double v, double inverse,
                            double reach, const Visit& visit) {
  const int last = end_of_slabs(s, v), next = v < 0 ? -1 : 1;
  for (; i != last; i += next) {
    if (slab_is_beyond(s, i, p, v, inverse, reach)) return;
    if (visit(static_cast<unsigned>(s.daughter[i])) && !is_along(v)) return;
  }
}

/// The same from the first position on; `left`: see first_slab.
template <class Index, class Visit>
inline void walk_slabs(const SlabRow<Index>& s, double p, double v, double inverse, double reach,
                       unsigned left, const Visit& visit) {
  walk_slabs_from(s, first_slab<false>(s, p, v, left), p, v, inverse, reach, visit);
}

/// Calls visit(daughter) for those that may hold the point.
template <class Index, class Visit>
inline void visit_slabs_at(const SlabRow<Index>& s, double p, const Visit& visit) {
  const int b = cell_along(p, s.origin, s.per_mm, s.cells);
  for (int i = static_cast<int>(s.ascending[b]); i < s.count && s.low[i] <= p; ++i) {
    visit(static_cast<unsigned>(s.daughter[i]));
  }
}

}  // namespace navjit::kernels
