// The source of a plugin: a module of navigators, and the data by which it is recognised.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/facts.hpp"
#include "codegen/module.hpp"

namespace navjit {

/// Of the symbols below; a plugin of another version is refused.
constexpr unsigned plugin_format = 2;

/// SHA-256, in hexadecimal, of the sources of kernels, analysis and code generation: navigators
/// made by others may round otherwise, or have faults that were mended since.
const char* generator_fingerprint();

/// Header-free C++ for Clang, to be compiled without contraction of floating point. No name from
/// the detector is in it but as letters, digits and underscores. Exports, beside the functions:
///   unsigned navjit_plugin_format, navjit_plugin_abi, navjit_plugin_count;
///   char navjit_plugin_geometry[], navjit_plugin_generator[], navjit_plugin_features[];
///   unsigned navjit_plugin_hot[], for which, and char navjit_plugin_source[], from what module it
///   was made: who loads it makes that module again for the tables that its code is handed;
///   unsigned navjit_plugin_volumes[]; and of functions navjit_plugin_steps[], _relocates[].
std::string plugin_source(const Geometry& geometry, const WorldFacts& facts,
                          std::span<const VolumeId> volumes);

/// SHA-256 of a module's source, in hexadecimal.
std::string module_fingerprint(const codegen::Module& module);

/// Features ("-name") that have to be turned off for a plugin, so that what it needs can be asked
/// of a processor without LLVM. `host` has the features of the processor it is compiled for.
std::vector<std::string> features_to_avoid(std::span<const std::string> host);

}  // namespace navjit
