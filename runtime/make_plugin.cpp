#include "runtime/make_plugin.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>

#include "analysis/plan.hpp"
#include "cache/trust.hpp"
#include "files/output_file.hpp"
#include "jit/compiler.hpp"
#include "navjit/errors.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/instruction_set.hpp"
#include "runtime/plugin.hpp"
#include "runtime/plugin_text.hpp"
#include "runtime/private_folder.hpp"

namespace navjit {
namespace {

constexpr std::size_t max_library_bytes = std::size_t{256} << 20;

std::string system_problem(const std::string& what) { return what + ": " + std::strerror(errno); }

/// Runs a program and waits for it. Returns an empty string if it succeeded.
std::string run(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ);
  if (error != 0) {
    return "cannot run the linker '" + command[0] + "': " + std::strerror(error) +
           "; NAVJIT_LD can name another";
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? ""
                                                       : "the linker '" + command[0] + "' failed";
}

/// The bytes of a library, followed by a plugin's seal.
Expected<std::string> sealed(const std::string& path) {
  const cache::File file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) return Failure{system_problem(path)};
  const auto bytes = cache::read_all(file, max_library_bytes);
  if (!bytes) return Failure{path + ": " + bytes.failure().message};
  std::string library(bytes->data(), bytes->size());
  if (check_plugin_seal(library).empty()) return Failure{path + " is sealed already"};
  if (library.substr(0, 4) !=
      "\x7f"
      "ELF") {
    return Failure{path + " is no shared library"};
  }
  return library + plugin_seal(library);
}

void write(const Expected<std::string>& plugin, OutputFile& file) {
  if (!plugin) throw Error(plugin.failure().message);
  file.write(*plugin);
  file.finish();
}

}  // namespace

std::vector<VolumeId> hot_scenes(const StepProfile& profile, const Geometry& geometry,
                                 const WorldFacts& facts, const PluginChoice& choice) {
  if (profile.geometry != geometry_fingerprint(geometry)) {
    throw Error(
        "the profile is of another detector, another version of this one, or another observation "
        "of it");
  }
  std::map<VolumeId, double> counts;
  double total = 0;
  for (const StepProfile::Volume& v : profile.volumes) {
    if (v.volume >= geometry.size() || !facts.reachable[v.volume] ||
        geometry.world().volumes[v.volume].name != v.name) {
      throw Error("the profile has volumes that are not in the detector");
    }
    const double executions = static_cast<double>(v.steps) + static_cast<double>(v.relocations);
    counts[facts.first_equal[v.volume]] += executions;
    total += executions;
  }
  std::vector<std::pair<double, VolumeId>> hot;
  for (const auto& [volume, executions] : counts) {
    if (executions >= choice.least_share * total && executions > 0 &&
        worth_compiling(geometry, plan_scene(geometry, facts, volume))) {
      hot.emplace_back(-executions, volume);
    }
  }
  std::sort(hot.begin(), hot.end());
  if (hot.size() > choice.most_scenes) hot.resize(choice.most_scenes);
  std::vector<VolumeId> scenes;
  scenes.reserve(hot.size());
  for (const auto& [executions, volume] : hot) scenes.push_back(volume);
  return scenes;
}

Expected<std::string> plugin_bytes(const std::string& source, const PluginCode& code) {
  jit::CompileOptions options;
  options.optimisation = code.optimisation;
  options.cpu = processor_for(code.instruction_set, *spdlog::default_logger());
  options.features = features_to_avoid(jit::host_features());
  const auto object = jit::compile(source, "navjit_plugin", options);
  if (!object) return object.failure();
  const PrivateFolder folder;
  const TemporaryPath object_file(folder.file("plugin.o")), library(folder.file("plugin.so"));
  write_output(object_file.path(), {object->bytes.data(), object->bytes.size()});
  const char* linker = std::getenv("NAVJIT_LD");
  // Calls between the plugin's own functions stay direct. All its symbols are resolved on loading,
  // or loading fails.
  const std::string problem =
      run({linker != nullptr ? linker : "ld", "-shared", "-Bsymbolic", "-z", "now", "-z", "relro",
           "-z", "noexecstack", "-o", library.path(), object_file.path()});
  if (!problem.empty()) return Failure{problem};
  return sealed(library.path());
}

void make_plugin(const std::string& source, const PluginCode& code, const std::string& path) {
  OutputFile file(path, plugin_mode);
  write(plugin_bytes(source, code), file);
}

void seal_plugin(const std::string& path) {
  OutputFile file(path, plugin_mode);
  write(sealed(path), file);
}

}  // namespace navjit
