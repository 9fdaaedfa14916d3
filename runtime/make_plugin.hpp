// Makes a plugin's source and file from a choice of scenes.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "analysis/facts.hpp"
#include "navjit/detail/expected.hpp"
#include "navjit/options.hpp"
#include "navjit/step_profile.hpp"

namespace navjit {

struct PluginChoice {
  /// Scenes with a smaller share of all steps and relocations are left out.
  double least_share = 0.001;
  std::size_t most_scenes = 64;
};

/// The scenes of a profile that are hot enough and worth compiling, hottest first. Equal volumes
/// count together, and only one of them is returned. Throws Error if the profile is not of this
/// detector.
std::vector<VolumeId> hot_scenes(const StepProfile& profile, const Geometry& geometry,
                                 const WorldFacts& facts, const PluginChoice& choice = {});

/// What the compiler is told about a plugin.
struct PluginCode {
  int optimisation = 2;
  /// Of this machine's processor. A set that it lacks counts as native, with a warning in the log.
  InstructionSet instruction_set = InstructionSet::native;
};

/// Compiles a plugin's source for this machine's processor and links it with the system's linker,
/// `ld` or the one that NAVJIT_LD names. Returns the plugin's bytes, or why there are none.
/// Temporary files are in a PrivateFolder, which may throw.
Expected<std::string> plugin_bytes(const std::string& source, const PluginCode& code);

/// Permissions of plugins, whatever the umask is. A plugin that a group may write is not loaded.
constexpr mode_t plugin_mode = 0644;

/// The same, but writes the plugin to a file (files/output_file.hpp). Throws Error.
void make_plugin(const std::string& source, const PluginCode& code, const std::string& path);

/// Seals a library that was compiled by other means: appends the seal with which a plugin ends.
/// Throws Error.
void seal_plugin(const std::string& path);

}  // namespace navjit
