// A ray for each pixel, on several threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "apps/picture/cuts.hpp"
#include "apps/picture/view.hpp"
#include "apps/picture/visible.hpp"
#include "navjit/runtime.hpp"

namespace navjit::picture {

/// How a picture is made, whatever is in it.
struct Frame {
  int width = 800, height = 600;
  unsigned threads = 1;
  View view{};
  std::vector<Cut> cuts{};
  /// Told how many rows are done, one call at a time.
  std::function<void(int)> progress{};
};

/// What of a detector a pixel shows.
struct Surface {
  static constexpr VolumeId nothing = ~VolumeId{0}, stuck = nothing - 1;
  VolumeId volume = nothing;
  float light = 1;  ///< 0 to 1
  TouchableId touchable = 0;
};

/// The first opaque volume that each pixel's ray meets; row by row from the top left. Surfaces are
/// lit by a lamp behind the viewer.
std::vector<Surface> surfaces(Runtime& runtime, const Visible& visible, const Frame& frame);

/// What is where parallel rays pass a plane across them: at `depth` mm from their starts.
/// Everything that is counted is shown, gases too.
std::vector<Surface> slice(Runtime& runtime, const Visible& visible, const Frame& frame,
                           double depth);

/// What of a ray is summed up for its pixel.
enum class Quantity : std::uint8_t { path, radiation_lengths, mass, steps };

/// The sums: mm in opaque volumes, radiation lengths and g/cm2 in all that is counted, or steps
/// (in all, cuts or not). Not a number where the ray got stuck.
std::vector<double> values(Runtime& runtime, const Visible& visible, const Frame& frame,
                           Quantity quantity);

/// ns that each pixel's ray took through everything, cuts or not: with one runtime, and with
/// another. The least of some passes over the whole picture, in turn, so that what else the machine
/// does hardly counts. `frame.progress` is told rows of all passes.
struct Times {
  std::vector<double> before, after;
};
constexpr int time_passes = 3;
Times times(Runtime& before, Runtime& after, const Frame& frame);

}  // namespace navjit::picture
