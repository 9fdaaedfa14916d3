// Traces of rays (every step of every ray), from files or made here, and their comparison.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/model/world.hpp"
#include "navjit/options.hpp"
#include "runtime/transport.hpp"

namespace navjit::reference {

/// One row of a trace.
struct TraceStep {
  std::string volume;  ///< logical volume in which the step was made
  double length = 0;   ///< mm; not meaningful if stuck
  bool stuck = false;  ///< the ray was given up here

  friend bool operator==(const TraceStep&, const TraceStep&) = default;
};

/// The steps of every ray, by the ray's number. A ray that starts outside the world has none.
using Trace = std::vector<std::vector<TraceStep>>;

/// Reads a trace of `rays` rays: header `ray,step,volume,length`, lengths in mm or `stuck`; plain
/// or gzip. Throws std::runtime_error with file and line if it is anything else, if rays or steps
/// are out of order, if the number of a ray is not below `rays`, or if rows follow a stuck one.
Trace read_trace(const std::filesystem::path& path, std::size_t rays);

/// Transports the rays through the world on the calling thread and keeps every step.
Trace make_trace(std::shared_ptr<const World> world, std::span<const Ray> rays, JitMode jit);

/// When two traces of a ray count as equal. Engines differ in where they put points that lie on a
/// boundary, so steps shorter than `sliver` are dropped first, on both sides.
struct Criteria {
  double sliver = 1e-6;     ///< mm
  double length = 1e-6;     ///< mm by which lengths may differ
  double relative = 1e-13;  ///< or, where that is more, this share of the larger length; a step
                            ///< below this share of its ray is a sliver, too
};

/// Where the traces of a ray begin to differ.
struct Difference {
  std::size_t ray = 0;
  std::size_t step = 0;   ///< number of our step at that place, slivers counted
  double distance = 0;    ///< of that place from the start of the ray, mm
  std::string ours = {};  ///< the rows there, in words
  std::string theirs = {};
};

struct Comparison {
  std::size_t rays = 0;
  std::size_t differing = 0;  ///< rays; a stuck ray always differs
  std::size_t merged = 0;     ///< rays equal only after merging neighbours in equal-named volumes
  std::size_t stuck = 0;      ///< rays stuck in our trace
  std::size_t stuck_theirs = 0;
  std::size_t steps = 0;                     ///< of our trace, without slivers
  std::vector<Difference> differences = {};  ///< the first few, by ray

  /// Part of the rays that agree; 1 if there are none.
  double agreement() const;
};

/// Compares ray by ray: volumes in order, and lengths. Where they differ, compares again with
/// adjacent steps in volumes of equal name merged (copies that touch, or a step that one side made
/// in two). At most `examples` differences are kept in words. Throws std::invalid_argument if the
/// traces do not have the same number of rays.
Comparison compare(const Trace& ours, const Trace& theirs, const Criteria& criteria = {},
                   std::size_t examples = 5);

/// Writes one line for each difference that was kept.
std::ostream& operator<<(std::ostream& out, const Comparison& comparison);

}  // namespace navjit::reference
