// Code for hot solids that are made of several, wherever they occur. Private to runtime/.
#pragma once

#include <set>

#include "runtime/specialisation.hpp"

namespace navjit {

/// How many times what was spent in the best of them so far has paid for compiling it; 0 if none is
/// due.
double solids_paid(Specialisation& spec);

/// Compiles the solids on which most was spent so far for what they cost, but for others than the
/// first that have paid fewer than `least` times, verifies them, and has the scenes that hold them
/// bound to data again, with their code. False if the run has ended, or nothing can be compiled any
/// more.
bool compile_solids(Specialisation& spec, double least);

/// Before a run: those of all volumes but these, what occurs most often first, until that has taken
/// so much of the thread's time. Which they are does not depend on timings, so that another run
/// finds them in the cache.
void compile_solids_of_all(Specialisation& spec, const std::set<VolumeId>& but, double most_ms);

}  // namespace navjit
