// The kinds of solids.
#pragma once

#include <cstdint>

namespace navjit::kernels {

/// What a solid is, as far as its mathematics goes: several solids of GDML may be of one kind.
enum class SolidKind : std::uint8_t {
  box,
  tube,
  cone,
  trd,
  trap,
  hull,
  facets,
  prism,
  arb8,
  cut_tube,
  orb,
  sphere,
  polycone,
  polyhedra,
  torus,
  ellipsoid,
  eltube,
  elcone,
  paraboloid,
  hype,
  twistedtubs,
  twistedbox,
  twistedtrd,
  twistedtrap,
  placed,
  scaled,
  union_of,
  intersection_of,
  subtraction_of,
  foreign,
};

template <class Real>
struct AnySolid;

}  // namespace navjit::kernels

namespace navjit {

using kernels::SolidKind;

}  // namespace navjit
