// Proof before use: a specialised navigator against the generic one, on given states.
#pragma once

#include <span>
#include <string>

#include "geometry/navigation/geometry.hpp"
#include "navjit/detail/profile.hpp"

namespace navjit {

/// Compares length (bits), boundary flag and the whole next stack, for steps from the samples and
/// for relocation at the ends of those steps. Samples of other volumes are passed over. Returns an
/// empty string, or the first state that differs, in words.
std::string verify(const Geometry& geometry, const kernels::Context& context,
                   const kernels::DispatchEntry& specialised, VolumeId volume,
                   std::span<const Sample> samples);

/// Mean processor time of a step from the samples, ns: the best of a few passes. 0 without samples.
double time_per_step(const Geometry& geometry, const kernels::Context& context,
                     const kernels::DispatchEntry& entry, std::span<const Sample> samples);

}  // namespace navjit
