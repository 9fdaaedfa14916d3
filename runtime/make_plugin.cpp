#include "runtime/make_plugin.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>

#include "analysis/plan.hpp"
#include "jit/compiler.hpp"
#include "jit/trust.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/plugin.hpp"
#include "runtime/plugin_text.hpp"

namespace navjit {
namespace {

constexpr std::size_t max_library_bytes = std::size_t{256} << 20;

/// Removes a file at the end, whatever happens.
struct Temporary {
  std::string path;
  ~Temporary() { unlink(path.c_str()); }
};

std::string system_problem(const std::string& what) { return what + ": " + std::strerror(errno); }

/// Writes a new file; empty on success.
std::string write_file(const std::string& path, std::string_view bytes) {
  const jit::File file(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (!file) return system_problem(path);
  // Also where the user's files are made to be written by a group: such plugins are refused.
  fchmod(file.get(), 0644);
  while (!bytes.empty()) {
    const ssize_t n = write(file.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return system_problem(path);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return "";
}

/// Runs a program and waits for it; empty if it ended well.
std::string run(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
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

std::string seal_to(const std::string& from, const std::string& to) {
  const jit::File file(open(from.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) return system_problem(from);
  const auto bytes = jit::read_all(file, max_library_bytes);
  if (!bytes) return from + ": " + bytes.failure().message;
  std::string sealed(bytes->data(), bytes->size());
  if (check_plugin_seal(sealed).empty()) return from + " is sealed already";
  if (sealed.substr(0, 4) !=
      "\x7f"
      "ELF")
    return from + " is no shared library";
  sealed += plugin_seal(sealed);
  const Temporary beside{to + ".new" + std::to_string(getpid())};
  std::string problem = write_file(beside.path, sealed);
  if (problem.empty() && rename(beside.path.c_str(), to.c_str()) != 0) problem = system_problem(to);
  return problem;
}

}  // namespace

std::vector<VolumeId> hot_scenes(const StepProfile& profile, const Geometry& geometry,
                                 const WorldFacts& facts, const PluginChoice& choice) {
  if (profile.geometry != geometry_fingerprint(geometry)) {
    throw std::runtime_error("the profile is of another detector, or another version of this one");
  }
  std::map<VolumeId, double> heats;
  double total = 0;
  for (const StepProfile::Volume& v : profile.volumes) {
    if (v.volume >= geometry.size() || !facts.reachable[v.volume] ||
        geometry.world().volumes[v.volume].name != v.name) {
      throw std::runtime_error("the profile has volumes that are not in the detector");
    }
    const double heat = static_cast<double>(v.steps) + static_cast<double>(v.relocations);
    heats[facts.first_equal[v.volume]] += heat;
    total += heat;
  }
  std::vector<std::pair<double, VolumeId>> hot;
  for (const auto& [volume, heat] : heats) {
    if (heat >= choice.least_share * total && heat > 0 &&
        worth_compiling(geometry, plan_scene(geometry, facts, volume))) {
      hot.emplace_back(-heat, volume);
    }
  }
  std::sort(hot.begin(), hot.end());
  if (hot.size() > choice.most_scenes) hot.resize(choice.most_scenes);
  std::vector<VolumeId> scenes;
  for (const auto& [heat, volume] : hot) scenes.push_back(volume);
  return scenes;
}

std::string make_plugin(const std::string& source, int optimisation, const std::string& path) {
  jit::CompileOptions options;
  options.optimisation = optimisation;
  options.features = features_to_avoid(jit::host_features());
  const auto object = jit::compile(source, "navjit_plugin", options);
  if (!object) return object.failure().message;
  const std::string stem = path + ".new" + std::to_string(getpid());
  const Temporary object_file{stem + ".o"}, library{stem + ".so"};
  std::string problem = write_file(object_file.path, {object->bytes.data(), object->bytes.size()});
  if (!problem.empty()) return problem;
  const char* linker = std::getenv("NAVJIT_LD");
  // Calls between its own functions stay direct; all symbols are found on loading, or it fails.
  problem = run({linker != nullptr ? linker : "ld", "-shared", "-Bsymbolic", "-z", "now", "-z",
                 "relro", "-z", "noexecstack", "-o", library.path, object_file.path});
  return problem.empty() ? seal_to(library.path, path) : problem;
}

std::string seal_plugin(const std::string& path) { return seal_to(path, path); }

}  // namespace navjit
