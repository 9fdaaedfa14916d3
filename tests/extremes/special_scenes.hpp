// Detectors, as GDML; each is extreme in its own way.
#pragma once

#include <string>
#include <vector>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::extremes {

std::string thin_shells();
/// `self_crossing`: only then are there tori whose tube is wider than their ring.
std::string odd_tori(bool self_crossing);
std::string odd_cones();
std::string odd_wedges();
std::string touching_volumes();
std::string nested_copies();
std::string doubled_volumes();
/// `outer` slabs of `inner` slabs each, all in contact, along z.
std::string chain(int outer, int inner);
/// Rays along all of the chain, exactly and nearly so.
std::vector<Ray> chain_rays(const World& world);

}  // namespace navjit::extremes
