// Words on a command line that stand for values.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "navjit/options.hpp"

namespace navjit::common {

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

inline const Choices<InstructionSet> instruction_sets{{"native", InstructionSet::native},
                                                      {"sse4.2", InstructionSet::sse42},
                                                      {"avx2", InstructionSet::avx2},
                                                      {"avx512", InstructionSet::avx512}};

}  // namespace navjit::common
