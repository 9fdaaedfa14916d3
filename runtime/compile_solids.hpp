// Code for hot solids that are composed of several, wherever they occur. Private to runtime/.
#pragma once

#include <set>

#include "runtime/specialisation.hpp"

namespace navjit {

/// How many times the time spent in the best of these solids so far has paid for compiling it; 0 if
/// none is due.
double solids_paid(Specialisation& spec);

/// Compiles the solids with the most time spent in them for their expected compile time, verifies
/// them, and lets the scenes that hold them be bound to data again, with the code. The best solid
/// comes first; others are included only if they have paid at least `least` times. Returns false if
/// the run has ended, or if nothing can be compiled any more.
bool compile_solids(Specialisation& spec, double least);

/// Before a run: compiles the solids of all volumes except those in `but`, the ones that occur most
/// often first, until that has taken `most_ms` of this thread's processor time. The choice does not
/// depend on timings, so that another run finds the same solids in the cache.
void compile_solids_of_all(Specialisation& spec, const std::set<VolumeId>& but, double most_ms);

}  // namespace navjit
