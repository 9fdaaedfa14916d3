// Steps of length zero, as an optical photon makes them after a reflection: the photon is in the
// volume behind the boundary, and its direction leads back. Specialised navigators call these
// functions for them; they give what generic::step() gives, without a search among all daughters.
#pragma once

#include "geometry/navigation/navigation_stack.hpp"

namespace navjit {

/// The track is at the surface of its volume and heads out; see kernels::LeaveFunction.
void leave_at_once(NavigationStack* stack, const kernels::Context* context, double x, double y,
                   double z);

/// The track is at the surface of the daughter that was left last, and heads back into it; see
/// kernels::ReturnFunction.
double return_at_once(NavigationStack* stack, const kernels::Context* context, double x, double y,
                      double z);

}  // namespace navjit
