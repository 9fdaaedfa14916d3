// Proof before use: a specialised navigator against the generic one, on given states.
#pragma once

#include <span>
#include <string>

#include "geometry/navigation/geometry.hpp"
#include "navjit/detail/profile.hpp"

namespace navjit {

/// Compares, from each sample of the volume: a step's length (bits), its boundary flag and the
/// whole next stack; the stack after relocation at the sample's point, out of nothing and out of
/// one of the daughters; the safety (bits). Samples of other volumes are passed over. Returns an
/// empty string; or the first state that differs, in words; or that there was no sample of the
/// volume, which proves nothing.
std::string verify(const Geometry& geometry, const kernels::Context& context,
                   const kernels::DispatchEntry& specialised, VolumeId volume,
                   std::span<const Sample> samples);

/// Mean processor time of a step from the samples, ns: the best of a few passes. 0 without samples.
double time_per_step(const Geometry& geometry, const kernels::Context& context,
                     const kernels::DispatchEntry& entry, std::span<const Sample> samples);

}  // namespace navjit
