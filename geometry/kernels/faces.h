// Flat faces of a convex body, several at once. The quotients are those of clip_face and leave_face
// (convex.h), and the same ones are chosen, so the bits are those of one face after the other. This
// saves branches that are often mispredicted: nobody can foresee which faces a ray enters by.
namespace navjit::kernels {

/// What clip_face and leave_face need to know of several faces, one face in each lane. A face may
/// occur twice.
template <class Lanes>
struct FaceLanes {
  Lanes beyond;  ///< the signed distance of a point
  Lanes nv;      ///< the outward unit normal times the direction
};

/// The result of a comparison of lanes.
template <class Lanes>
using MaskOf = decltype(Lanes{} > Lanes{});

inline bool any_lane(MaskOf<Doubles> set) { return bits_of(__builtin_bit_cast(Words, set)) != 0; }
inline bool any_lane(MaskOf<EightLanes> set) {
  return bits_of(__builtin_bit_cast(EightWords, set)) != 0;
}

/// The span that clip_face makes of all faces that are passed to `clip`.
template <class Lanes>
struct FaceSpans {
  // leave_back and until_back are minus the paths to where the ray leaves, so that one quotient
  // serves for entering and for leaving.
  Lanes enter = Lanes{} - infinity<double>(), leave_back = enter, until_back = enter;
  MaskOf<Lanes> passed{};  ///< whether the ray is along a face and beyond it

  void clip(const FaceLanes<Lanes>& f, double tol) {
    const double along = along_a_face<double>();
    const auto in = f.nv < -along;
    const auto out = f.nv > along;
    const auto outside = f.beyond > tol;
    const Lanes back = f.beyond / f.nv, ahead = -back, until = (f.beyond + tol) / f.nv;
    passed |= ~(in | out) & outside;
    enter = (in & outside & (ahead > enter)) ? ahead : enter;
    leave_back = (out & (back > leave_back)) ? back : leave_back;
    until_back = (out & (until > until_back)) ? until : until_back;
  }
  Span<double> span() const {
    if (any_lane(passed)) return no_span<double>();
    return {largest_lane(enter), -largest_lane(leave_back), -largest_lane(until_back)};
  }
};

/// The exit that leave_face finds for all faces that are passed to `leave`.
template <class Lanes>
struct FaceExits {
  Lanes leave_back = Lanes{} - infinity<double>();  ///< minus the path
  MaskOf<Lanes> at_once{};

  void leave(const FaceLanes<Lanes>& f, double tol) {
    const double along = along_a_face<double>();
    const auto in = f.nv < -along;
    const auto out = f.nv > along;
    at_once |= (out & (f.beyond >= -tol)) | (~(in | out) & (f.beyond > tol));
    const Lanes back = f.beyond / f.nv;
    leave_back = (out & (back > leave_back)) ? back : leave_back;
  }
  double path() const { return any_lane(at_once) ? 0.0 : -largest_lane(leave_back); }
};

/// Whether beyond_face holds for any of the faces.
template <class Lanes>
inline bool beyond_any(const FaceLanes<Lanes>& f, double tol) {
  return any_lane((f.beyond > tol) | ((f.beyond >= -tol) & (f.nv > along_a_face<double>())));
}

/// Is the start beyond any of the faces and the ray not heading in through it? Then the body is not
/// ahead, and no quotient is needed.
template <class Lanes>
inline bool passes_any(const FaceLanes<Lanes>& f, double tol) {
  return any_lane((f.beyond > tol) & (f.nv >= -along_a_face<double>()));
}

}  // namespace navjit::kernels
