#include "runtime/plugin_text.hpp"

#include <algorithm>

#include "cache/sha256.hpp"
#include "runtime/fingerprint.hpp"
#include "runtime/plugin_features.hpp"

namespace navjit {
namespace {

std::string constant(const std::string& type, const std::string& name, const std::string& value) {
  return "extern __attribute__((visibility(\"default\"))) " + type + " navjit_plugin_" + name +
         ";\n" + type + " navjit_plugin_" + name + " = " + value + ";\n";
}

}  // namespace

std::string module_fingerprint(const codegen::Module& module) {
  return cache::hex(cache::sha256({module.source}));
}

std::string plugin_source(const Geometry& geometry, const WorldFacts& facts,
                          std::span<const VolumeId> volumes) {
  const codegen::Module module = codegen::generate(geometry, facts, volumes);
  std::string hot;
  for (const VolumeId volume : volumes) hot += std::to_string(volume) + ", ";
  std::string numbers, steps, relocates, safeties;
  for (const codegen::Entry& entry : module.entries) {
    numbers += std::to_string(entry.volume) + ", ";
    steps += entry.step + ", ";
    relocates += entry.relocate + ", ";
    safeties += (entry.safety.empty() ? "nullptr" : entry.safety) + ", ";
  }
  // The preprocessor tells what the compiler was allowed to use, whoever calls it.
  std::string features = "\"\"";
#define NAVJIT_FEATURE(name, macro) features += "\n#ifdef " macro "\n\"" name " \"\n#endif";
  NAVJIT_PLUGIN_FEATURES(NAVJIT_FEATURE)
#undef NAVJIT_FEATURE
  std::string text =
      "#if !defined(__clang__) || __clang_major__ < 18\n"
      "#error \"plugins of navjit are compiled with Clang, 18 or newer\"\n"
      "#endif\n" +
      module.source;
  text += "\nextern \"C\" {\n";
  text += constant("const unsigned", "format", std::to_string(plugin_format));
  text += constant("const unsigned", "abi", "navjit::kernels::abi_version");
  text += constant("const unsigned", "count", std::to_string(module.entries.size()));
  text += constant("const unsigned", "hot_count", std::to_string(volumes.size()));
  const auto array = [&](const std::string& type, const std::string& name,
                         const std::string& value) {
    text += "extern __attribute__((visibility(\"default\"))) " + type + " navjit_plugin_" + name +
            "[];\n" + type + " navjit_plugin_" + name + "[] = " + value + ";\n";
  };
  array("const char", "geometry", "\"" + geometry_fingerprint(geometry) + "\"");
  array("const char", "generator", "\"" + std::string(generator_fingerprint()) + "\"");
  array("const char", "features", features + "\n");
  array("const char", "source", "\"" + module_fingerprint(module) + "\"");
  array("const unsigned", "hot", "{" + hot + "}");
  array("const unsigned", "volumes", "{" + numbers + "}");
  text += "using namespace navjit::kernels;\n";
  array("const navjit::kernels::StepFunction", "steps", "{" + steps + "}");
  array("const navjit::kernels::RelocateFunction", "relocates", "{" + relocates + "}");
  array("const navjit::kernels::SafetyFunction", "safeties", "{" + safeties + "}");
  return text + "}\n";
}

std::vector<std::string> features_to_avoid(std::span<const std::string> host) {
  std::vector<std::string> avoid;
  for (const std::string& feature : host) {
    bool known = feature == "evex512";  // comes with avx512f
#define NAVJIT_FEATURE(name, macro) known = known || feature == (name);
    NAVJIT_PLUGIN_FEATURES(NAVJIT_FEATURE)
#undef NAVJIT_FEATURE
    if (!known) avoid.push_back("-" + feature);
  }
  return avoid;
}

}  // namespace navjit
