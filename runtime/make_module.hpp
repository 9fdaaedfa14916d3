// Makes and installs code for chosen scenes. Private to runtime/.
#pragma once

#include <vector>

#include "codegen/module.hpp"
#include "runtime/module_list.hpp"
#include "runtime/specialisation.hpp"

namespace navjit {

/// The scenes of one module. The first of equal volumes stands for all of them.
using Batch = std::vector<VolumeId>;

/// Generates the module of these scenes. `along_faces`: with code for rays along faces and from
/// within daughters. `leaves`: whether leaves that can share code do so.
codegen::Module generate(Specialisation& spec, const Batch& batch, bool along_faces,
                         codegen::Leaves leaves);

/// Must be called after a compilation that failed and was not stopped: time that was spent in vain
/// counts, too, where compiling is limited to a share of the run. `start` is in steady_seconds().
void count_in_vain(Specialisation& spec, double start);

/// Must be called after a failure to compile. Returns whether nothing more can be compiled in this
/// run; if so, says it in the log.
bool nothing_more(Specialisation& spec, const Failure& failure);

/// Takes a module from the cache, or compiles it, and installs it. If it does not compile, each of
/// its scenes is tried alone. Returns the modules that were made, as they are to be listed; none if
/// the run ended first.
std::vector<ListedModule> make_modules(Specialisation& spec, const Batch& batch);

}  // namespace navjit
