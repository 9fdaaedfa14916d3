// What `navjit warmup` measured, as a page.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/warmup/experiment.hpp"

namespace navjit::warmup {

/// One file of HTML that needs no other. `facts`: what else is told of program and machine.
std::string page(const ExperimentReport& report, const std::string& title,
                 const std::vector<std::pair<std::string, std::string>>& facts);

}  // namespace navjit::warmup
