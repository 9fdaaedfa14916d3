// The source of a plugin: a module of navigators, and the data by which the plugin is recognised.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/facts.hpp"
#include "codegen/module.hpp"

namespace navjit {

/// The version of the symbols below; a plugin of another version is refused.
constexpr unsigned plugin_format = 2;

/// SHA-256, in hexadecimal, of the sources of kernels, analysis and code generation. Navigators
/// made by others may round differently, or have faults that have been mended.
const char* generator_fingerprint();

/// C++ without includes, for Clang, which must be compiled without contraction of floating point.
/// Names from the detector appear in it only as letters, digits and underscores. Besides the
/// functions it exports:
///   unsigned navjit_plugin_format, navjit_plugin_abi, navjit_plugin_count,
///     navjit_plugin_hot_count;
///   char navjit_plugin_geometry[], navjit_plugin_generator[], navjit_plugin_features[];
///   unsigned navjit_plugin_hot[], the scenes for which the plugin was made;
///   char navjit_plugin_source[], the fingerprint of its module: the program that loads the plugin
///     makes this module again, for the tables that the code works on;
///   unsigned navjit_plugin_volumes[], and in the same order the functions
///     navjit_plugin_steps[], navjit_plugin_relocates[] and navjit_plugin_safeties[] (null if there
///     is no code for the safety).
std::string plugin_source(const Geometry& geometry, const WorldFacts& facts,
                          std::span<const VolumeId> volumes);

/// SHA-256 of a module's source, in hexadecimal.
std::string module_fingerprint(const codegen::Module& module);

/// Features ("-name") that have to be turned off for a plugin: those for which the program that
/// loads it could not ask a processor without LLVM. `host` has the features of the processor for
/// which the plugin is compiled.
std::vector<std::string> features_to_avoid(std::span<const std::string> host);

}  // namespace navjit
