// What the processes of one run made, put together.
#pragma once

#include <string>
#include <vector>

#include "apps/mpi/processes.hpp"
#include "apps/run/report.hpp"
#include "navjit/step_profile.hpp"

namespace navjit::apps {

/// What each process made, as texts, by rank.
struct Made {
  std::vector<std::string> reports, profiles, series;
};

/// All processes call it, each with its own; the first one gets them all.
Made gather(Processes& processes, const RunReport& report, const StepProfile& profile);

/// Makes the first process's report and profile those of the whole run: counts, lengths and speeds
/// are sums (merge/reports.hpp). What belongs to no sum, as the machine and what is observed, stays
/// as it is. Throws Error for reports that do not go together.
void merge(const Made& made, RunReport& report, StepProfile& profile);

}  // namespace navjit::apps
