// The same detector computed with 113 bits: tests and `navjit accuracy` judge navigators by it. It
// is slow and plain: nothing speeds it up but boxes, looked at one by one, that show which
// daughters are surely not involved.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/model/world.hpp"
#include "geometry/solids/widen.hpp"

namespace navjit::reference {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
#else
typedef long double Quad;  // IEEE's quadruple precision where it has no name of its own
#endif
static_assert(sizeof(Quad) == 16);
using WidePoint = kernels::Vec3<Quad>;
using WideDirection = kernels::Direction<Quad>;

WidePoint widen(const Vec3& p);
WideDirection widen_direction(const Vec3& v);
/// p + t v, with no rounding but that of 113 bits.
WidePoint along(const Vec3& p, const Vec3& v, double t);

/// What the reference says about a point that a navigator claims to be in a touchable.
enum class Verdict : std::uint8_t {
  right,            ///< in the touchable, and in nothing below it
  near_a_boundary,  ///< within the tolerance of a surface that matters: nothing is claimed
  overlap,          ///< right, but the file also has a sister there
  protrusion,       ///< right, but the file's mother is not there
  outside,          ///< wrong: not in the touchable's own solid
  missed_daughter,  ///< wrong: in a daughter of the touchable
};
const char* name_of(Verdict verdict);
constexpr bool is_wrong(Verdict v) { return v >= Verdict::outside; }

/// A touchable, as the numbers of the daughters on the way down from the world.
using Chain = std::vector<std::uint32_t>;
Chain chain_of(const World& world, TouchableId touchable);

/// One step of a reference trace.
struct WideStep {
  VolumeId volume;  ///< in which the step was made
  Quad length;      ///< mm
};

/// One step from a state that a navigator claims to be in.
struct WideAnswer {
  Quad length;       ///< mm
  bool inside;       ///< true: there is a next touchable; false: the world was left
  Chain next;        ///< the next touchable
  VolumeId surface;  ///< whose surface ended the step: that of the touchable, or of a daughter
  double magnitude;  ///< largest coordinate of both ends in the frames of both touchables and of
                     ///< all above them, mm: its last bit is what rounding costs
};

/// The world's solids and placements in numbers of 113 bits, taken from the doubles of the model,
/// which define the detector. Frames are applied level by level. Immutable.
class WideGeometry {
 public:
  explicit WideGeometry(std::shared_ptr<const World> world);

  const World& world() const { return *world_; }

  /// Judges the claim that the innermost touchable at a global point is that of `chain`. All
  /// surfaces count as `tolerance` mm thick on either side.
  Verdict judge(const Chain& chain, const WidePoint& point, double tolerance) const;

  /// The innermost touchable that holds the point; false if the point is outside the world. On
  /// surfaces the direction decides; where daughters overlap, the last in file order.
  bool locate(const WidePoint& point, const WideDirection& direction, Chain& chain) const;

  /// All steps of a ray from a global point until it leaves the world, as docs/tolerance.md defines
  /// the steps of navigators. Ends early, with `stuck` set, once the ray is stuck
  /// (detail::Standing).
  std::vector<WideStep> trace(const Vec3& point, const Vec3& direction, bool& stuck) const;

  /// One step from a global point that is in the touchable `chain`, or on its surface.
  WideAnswer step(const Chain& chain, const WidePoint& point, const WideDirection& direction) const;

  /// A distance, mm, that is no more than the distance from a global point to the nearest surface
  /// of the touchable, or of a daughter whose box, made wider by 100 tolerances, holds the point.
  /// Near to a face it is the distance from that face.
  Quad nearest_surface(const Chain& chain, const WidePoint& point) const;

  /// How much farther from a surface a step of `length` from `start` in the touchable ends than the
  /// right step of length `right` does, mm, and no more than the difference of the two lengths.
  /// Where the ray grazes a surface, this is the part that rounding explains.
  double across(const Chain& chain, const Vec3& start, const Vec3& direction, Quad length,
                Quad right) const;

  /// The distance from a point in the world to the world's outer surface.
  Quad exit(const Vec3& point, const Vec3& direction) const;
  /// Where a point is with respect to the world's outer surface.
  Side side_of_world(const WidePoint& point, double tolerance) const;

 private:
  struct Placed {
    Quad translation[3];
    Quad rotation[9];
    bool rotated;
    VolumeId volume;
  };
  struct Scene {
    kernels::AnySolid<Quad> solid;
    std::vector<Placed> daughters;
    std::vector<Extent> boxes;  ///< around the daughters, with a generous margin
  };
  /// A volume on the way down, with the ray in its frame.
  struct Level {
    VolumeId volume;
    std::uint32_t daughter;
    WidePoint p;
    WideDirection v;
  };

  static WidePoint to_local(const Placed& t, const WidePoint& p);
  static WideDirection to_local(const Placed& t, const WideDirection& v);
  void push(std::vector<Level>& levels, std::uint32_t daughter) const;
  void move(std::vector<Level>& levels, Quad t) const;
  void relocate(std::vector<Level>& levels, int blocked) const;
  Quad next(std::vector<Level>& levels, VolumeId& surface) const;
  std::vector<Level> levels_of(const Chain& chain, const WidePoint& point,
                               const WideDirection& direction) const;

  std::shared_ptr<const World> world_;
  std::vector<std::shared_ptr<const WideSolid<Quad>>> solids_;
  std::vector<Scene> scenes_;
};

}  // namespace navjit::reference
