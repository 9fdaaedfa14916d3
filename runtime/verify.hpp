// Verifies a specialised navigator against the generic one, on given states, before it is used.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "geometry/navigation/geometry.hpp"
#include "navjit/detail/profile.hpp"

namespace navjit {

/// What verify() says if there was no sample of the volume.
inline constexpr std::string_view no_state_to_verify_on =
    "no state in the volume was found to verify it on";

/// Compares, from each sample of the volume, the bits of a step's length, its boundary flag and the
/// whole next stack; the stack after relocation at the sample's point, on entering the volume and
/// on leaving one of its daughters; and the bits of the safety. Samples of other volumes are
/// skipped. Returns an empty string if all is equal. Otherwise it describes the first state that
/// differs, or says that there was no sample of the volume, which proves nothing.
std::string verify(const Geometry& geometry, const kernels::Context& context,
                   const kernels::DispatchEntry& specialised, VolumeId volume,
                   std::span<const Sample> samples);

/// Mean processor time of a step from the samples, ns, in the best of a few passes. 0 without
/// samples.
double time_per_step(const Geometry& geometry, const kernels::Context& context,
                     const kernels::DispatchEntry& entry, std::span<const Sample> samples);

}  // namespace navjit
