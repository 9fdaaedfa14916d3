#include "apps/options/machine.hpp"

#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "navjit/version.hpp"
#include "runtime/version.hpp"

namespace navjit::apps {
namespace {

std::string quoted_for_shell(const std::string& word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string processor_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const auto colon = line.find(": ");
    return colon == std::string::npos ? "" : line.substr(colon + 2);
  }
  return "";
}

}  // namespace

std::string command_line() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string text;
  for (std::string word; std::getline(in, word, '\0');) {
    text += (text.empty() ? "" : " ") + quoted_for_shell(word);
  }
  return text;
}

Machine this_machine() {
  Machine machine;
  machine.processor = processor_model();
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) {
    machine.processors = static_cast<unsigned>(CPU_COUNT(&set));
  }
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGE_SIZE);
  if (pages > 0 && page > 0) {
    machine.memory_mb =
        static_cast<unsigned long>(pages) / ((1UL << 20) / static_cast<unsigned long>(page));
  }
  if (utsname name; uname(&name) == 0) {
    machine.system = std::string(name.sysname) + " " + name.release + " " + name.machine;
  }
  return machine;
}

nlohmann::ordered_json circumstances_json() {
  const Machine machine = this_machine();
  return {{"version", version()},
          {"command", command_line()},
          {"machine",
           {{"processor", machine.processor},
            {"processors", machine.processors},
            {"memory_mb", machine.memory_mb},
            {"system", machine.system}}}};
}

std::string report_text(const nlohmann::ordered_json& report) {
  return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::vector<std::pair<std::string, std::string>> circumstances() {
  const Machine machine = this_machine();
  char memory[32];
  std::snprintf(memory, sizeof memory, "%.3g GB", static_cast<double>(machine.memory_mb) / 1024);
  return {{"command", command_line()},
          {"program", version_line()},
          {"processor", machine.processor + " (" + std::to_string(machine.processors) + ")"},
          {"memory", memory},
          {"system", machine.system}};
}

}  // namespace navjit::apps
