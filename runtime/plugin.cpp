#include "runtime/plugin.hpp"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <set>
#include <span>
#include <string_view>

#include "cache/sha256.hpp"
#include "cache/trust.hpp"
#include "geometry/navigation/generic.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/plugin_features.hpp"
#include "runtime/plugin_text.hpp"

namespace navjit {
namespace {

constexpr std::size_t max_plugin_bytes = std::size_t{512} << 20;
constexpr std::string_view seal_magic = "NAVJITP1";
constexpr std::size_t seal_bytes = 8 + 8 + 32;

template <class Value>
const Value* symbol(void* library, const char* name) {
  return static_cast<const Value*>(dlsym(library, name));
}

/// The first feature in a list separated by blanks that this processor lacks; empty if there is
/// none.
std::string missing_feature(std::string_view needed) {
  while (!needed.empty()) {
    const std::size_t blank = needed.find(' ');
    const std::string_view feature = needed.substr(0, blank);
    if (!feature.empty() && !processor_has(feature)) return std::string(feature);
    needed = blank == std::string_view::npos ? std::string_view{} : needed.substr(blank + 1);
  }
  return "";
}

/// Why the library does not fit this detector and program; empty if it does.
std::string unsuitable(void* library, const Geometry& geometry) {
  const auto* format = symbol<unsigned>(library, "navjit_plugin_format");
  if (format == nullptr) return "it is no plugin of navjit";
  if (*format != plugin_format) return "its format is that of another version: specialise again";
  const auto* abi = symbol<unsigned>(library, "navjit_plugin_abi");
  const auto* made_for = symbol<char>(library, "navjit_plugin_geometry");
  const auto* made_from = symbol<char>(library, "navjit_plugin_generator");
  const auto* features = symbol<char>(library, "navjit_plugin_features");
  if (abi == nullptr || made_for == nullptr || made_from == nullptr || features == nullptr) {
    return "it is no complete plugin";
  }
  if (*abi != kernels::abi_version || std::string_view(made_from) != generator_fingerprint()) {
    return "it was made by another version of navjit: specialise again";
  }
  if (made_for != geometry_fingerprint(geometry)) {
    return "it was made for another detector, another version of this one, or another observation "
           "of "
           "it: specialise again";
  }
  const std::string missing = missing_feature(features);
  return missing.empty() ? "" : "it needs a processor with " + missing;
}

/// The module from which the library was made. The library's code works on the tables of this
/// module.
Expected<codegen::Module> module_of(void* library, const Geometry& geometry) {
  const auto* count = symbol<unsigned>(library, "navjit_plugin_hot_count");
  const auto* hot = symbol<VolumeId>(library, "navjit_plugin_hot");
  const auto* source = symbol<char>(library, "navjit_plugin_source");
  if (count == nullptr || hot == nullptr || source == nullptr || *count > 2 * geometry.size() ||
      std::any_of(hot, hot + *count, [&](VolumeId v) { return v >= geometry.size(); })) {
    return Failure{"it is no complete plugin"};
  }
  codegen::Module module =
      codegen::generate(geometry, analyse_world(geometry), std::span(hot, *count));
  if (module_fingerprint(module) != source) {
    return Failure{"its scenes are not those of this detector: specialise again"};
  }
  return module;
}

/// A copy in memory, which stays as it was checked whatever becomes of the file: one that is
/// rewritten in place while its code runs would end the process. It is a file of its own, too, so
/// that the system's loader never takes it for a library that it has loaded before. No file where
/// the system gives none.
cache::File copy_in_memory(std::string_view bytes) {
  cache::File copy(memfd_create("navjit-plugin", MFD_CLOEXEC));
  while (copy && !bytes.empty()) {
    const ssize_t n = ::write(copy.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return cache::File();
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return copy;
}

/// By its descriptor: the file that was checked, whatever its name stands for by now.
void* load_library(const cache::File& file) {
  const std::string name = "/proc/self/fd/" + std::to_string(file.get());
  return dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
}

}  // namespace

std::string plugin_seal(std::string_view library) {
  std::string seal(seal_magic);
  for (int i = 0; i < 8; ++i) seal += static_cast<char>(library.size() >> (8 * i) & 0xff);
  const cache::Digest digest = cache::sha256({library, seal});
  seal.append(reinterpret_cast<const char*>(digest.data()), digest.size());
  return seal;
}

std::string check_plugin_seal(std::string_view file) {
  if (file.size() < seal_bytes) return "it is too short for a plugin";
  const std::string_view library = file.substr(0, file.size() - seal_bytes);
  const std::string_view seal = file.substr(library.size());
  if (seal.substr(0, seal_magic.size()) != seal_magic) {
    return "it is truncated, or no plugin: `navjit plugin seal` seals one that you compiled "
           "yourself";
  }
  return seal == plugin_seal(library) ? "" : "it is damaged: its checksum does not match";
}

bool processor_has(std::string_view feature) {
#if defined(__x86_64__)
#define NAVJIT_FEATURE(name, macro) \
  if (feature == (name)) return __builtin_cpu_supports(name) != 0;
  NAVJIT_PLUGIN_FEATURES(NAVJIT_FEATURE)
#undef NAVJIT_FEATURE
#endif
  (void)feature;
  return false;
}

Plugin::~Plugin() {
  if (library_ != nullptr) dlclose(library_);
}

Expected<std::shared_ptr<const Plugin>> Plugin::load_checked(const std::string& path,
                                                             const Geometry& geometry) {
  const auto fail = [&](const std::string& why) { return Failure{path + ": " + why}; };
  Expected<cache::File> file = cache::open_trusted_file(path);
  if (!file) return file.failure();
  cache::File copy;
  {
    const Expected<std::vector<char>> bytes = cache::read_all(*file, max_plugin_bytes);
    if (!bytes) return fail(bytes.failure().message);
    const std::string problem = check_plugin_seal({bytes->data(), bytes->size()});
    if (!problem.empty()) return fail(problem);
    copy = copy_in_memory({bytes->data(), bytes->size()});
  }
  void* library = copy ? load_library(copy) : nullptr;
  if (library != nullptr) {
    *file = std::move(copy);
  } else {
    // A system may allow no code from such copies.
    library = load_library(*file);
  }
  if (library == nullptr) {
    const char* why = dlerror();
    return fail(why != nullptr ? why : "it cannot be loaded");
  }
  std::shared_ptr<Plugin> plugin(new Plugin(*std::move(file), library));
  const std::string problem = unsuitable(library, geometry);
  if (!problem.empty()) return fail(problem);
  const auto* count = symbol<unsigned>(library, "navjit_plugin_count");
  const auto* volumes = symbol<unsigned>(library, "navjit_plugin_volumes");
  const auto* steps = symbol<kernels::StepFunction>(library, "navjit_plugin_steps");
  const auto* relocates = symbol<kernels::RelocateFunction>(library, "navjit_plugin_relocates");
  const auto* safeties = symbol<kernels::SafetyFunction>(library, "navjit_plugin_safeties");
  if (count == nullptr || volumes == nullptr || steps == nullptr || relocates == nullptr ||
      safeties == nullptr || *count > geometry.size()) {
    return fail("it is no complete plugin");
  }
  const Expected<codegen::Module> module = module_of(library, geometry);
  if (!module) return fail(module.failure().message);
  plugin->tables_ = module->owner;
  std::set<VolumeId> seen;
  for (unsigned i = 0; i < *count; ++i) {
    if (volumes[i] >= geometry.size() || !seen.insert(volumes[i]).second || steps[i] == nullptr ||
        relocates[i] == nullptr) {
      return fail("it is no complete plugin");
    }
    const kernels::SafetyFunction safety =
        safeties[i] != nullptr ? safeties[i] : generic::dispatch_entry.safety;
    plugin->entries_.push_back(
        {volumes[i], {steps[i], relocates[i], safety, module->data, module->data}});
  }
  return std::shared_ptr<const Plugin>(std::move(plugin));
}

Expected<std::shared_ptr<const Plugin>> Plugin::load(const std::string& path,
                                                     const Geometry& geometry) {
  try {
    return load_checked(path, geometry);
  } catch (const std::exception& error) {  // no memory, no SHA-256
    return Failure{path + ": " + error.what()};
  }
}

}  // namespace navjit
