// What `navjit accuracy` measured, as a page.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/accuracy/experiment.hpp"
#include "apps/accuracy/observed.hpp"

namespace navjit::accuracy {

/// What else is told of program and machine: what it is, and its value.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// One file of HTML that needs no other.
std::string page(const World& world, const ExperimentReport& report, const std::string& title,
                 const Facts& facts);

/// The same of observations (--observe).
std::string page(const std::vector<ObservedFigures>& figures, const std::string& title,
                 const Facts& facts);

}  // namespace navjit::accuracy
