// What `navjit run` tells, as a page: docs/report.md.
#pragma once

#include <string>

#include "apps/run/report.hpp"

namespace navjit::apps {

/// One file of HTML that needs no other. `hot_map`: a PNG picture of it; empty: none.
std::string run_page(const RunReport& report, const std::string& hot_map);

/// Time of rays through the whole detector, with generic navigators and with those of the runtime
/// as they are now, as a PNG picture. It takes some two seconds at the most, if a ray takes less
/// than a ms; empty where a picture in that time would be too small to tell anything.
std::string hot_map_of(Runtime& runtime, const RuntimeOptions& options, unsigned threads);

}  // namespace navjit::apps
