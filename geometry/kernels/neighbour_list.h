// What is known about the places where a track leaves a daughter. All navigators use the same
// record.
namespace navjit::kernels {

/// The record of one daughter: a box within which tracks leave it, and its neighbours, the only
/// daughters that can contain a point in this box (navjit::NeighbourLists). It is a cache line. The
/// box is in double precision: in single precision it would not hold the points on its own faces,
/// where tracks leave the daughter.
struct alignas(64) NeighbourList {
  double low[3], high[3];  ///< with the margin, in the mother's frame, mm
  unsigned first;          ///< where its neighbours begin in the list of all neighbours
  unsigned short count;
  unsigned short mother_contains;  ///< whether the mother contains all of the box
  unsigned block;                  ///< of the neighbours' boxes; no_block if there are none
  float margin;                    ///< by which the box is larger than the daughter's own, mm

  static constexpr unsigned short unlisted = 0xffff;
  static constexpr unsigned no_block = 0xffffffff;
  /// False if the neighbours are too many to be listed.
  bool listed() const { return count != unlisted; }
};

inline bool is_there(const NeighbourList& a, const Vec3<double>& p) {
  return (p.x >= a.low[0]) & (p.x <= a.high[0]) & (p.y >= a.low[1]) & (p.y <= a.high[1]) &
         (p.z >= a.low[2]) & (p.z <= a.high[2]);
}

/// Whether a ray that leaves the daughter at this point comes out of the daughter's box, and not
/// nearly along the face. Then all that is in the box is behind the ray.
inline bool comes_out_of_box(const NeighbourList& a, const Vec3<double>& p,
                             const Direction<double>& v, double tol) {
  constexpr double least_slope = 1e-3;
  const double margin = double{a.margin} + 0.25 * tol;
  const auto along = [&](int axis, double at, double rate) {
    const double beyond = rate < 0 ? a.low[axis] + margin - at : at - (a.high[axis] - margin);
    return (beyond >= 0) & (absolute(rate) > least_slope);
  };
  return along(0, p.x, v.x) | along(1, p.y, v.y) | along(2, p.z, v.z);
}

}  // namespace navjit::kernels
