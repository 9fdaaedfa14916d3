// What the processes of one run made, put together.
#pragma once

#include "apps/mpi/processes.hpp"
#include "apps/run/report.hpp"
#include "navjit/step_profile.hpp"

namespace navjit::apps {

/// All processes call it, each with its own; in the first one it then is the report, and the
/// profile, of the whole run: counts, lengths and speeds are sums (merge/reports.hpp). What belongs
/// to no sum, as the machine and what is observed, is the first process's.
void merge(Processes& processes, RunReport& report, StepProfile& profile);

}  // namespace navjit::apps
