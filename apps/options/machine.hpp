// Under what circumstances a run was made: what its report says of the program and the machine.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace navjit::apps {

/// The words that this program was called with, quoted for a shell where they need it; empty where
/// the system does not tell.
std::string command_line();

struct Machine {
  std::string processor;        ///< model, as the system names it; empty: not told
  unsigned processors = 0;      ///< that this process may use
  unsigned long memory_mb = 0;  ///< of the machine; 0: not told
  std::string system;           ///< kernel, its release, and the architecture
};
Machine this_machine();

/// "version", "command" and "machine", with which the reports of run, warmup and accuracy begin.
nlohmann::ordered_json circumstances_json();

/// A report as the text of its file. Names of files and volumes may be no UTF-8, which JSON cannot
/// hold: what is none becomes U+FFFD.
std::string report_text(const nlohmann::ordered_json& report);

/// Both in words, and what the program is: what and its value, for people.
std::vector<std::pair<std::string, std::string>> circumstances();

}  // namespace navjit::apps
