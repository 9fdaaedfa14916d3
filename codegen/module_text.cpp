#include "codegen/module_text.hpp"

#include "codegen/kernel_names.hpp"
#include "codegen/kernel_texts.hpp"

namespace navjit::codegen {
namespace {

constexpr const char* inlined =
    "#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)\n";
constexpr const char* as_it_is = "#pragma clang attribute pop\n";

void add_kernel(std::string& text, std::string_view kernel, bool small) {
  text += (small ? inlined : "") + std::string(kernel_text(kernel)) + (small ? as_it_is : "");
}

/// Whether the kernel is that of solids that most detectors have.
bool is_common(std::string_view kernel) {
  return kernel == "convex" || kernel == "box" || kernel == "wedge" || kernel == "tube";
}

std::string make_common_text() {
  std::string text = "#pragma clang diagnostic ignored \"-Winvalid-offsetof\"\n";
  for (const char* head : {"vectors", "prelude", "lanes"}) add_kernel(text, head, true);
  for (const std::string_view kernel : kernel_order()) {
    if (is_common(kernel)) add_kernel(text, kernel, true);
  }
  for (const char* kernel : scene_kernels()) add_kernel(text, kernel, true);
  add_kernel(text, "scene", false);
  add_kernel(text, "shared_leaf", false);
  return text;
}

}  // namespace

std::string entry_functions(const Entry& entry, const std::string& scene) {
  const std::string data = "const Context* context, const void* data, double x, double y, double z";
  std::string text = "extern \"C\" double " + entry.step + "(NavigationStack* stack, " + data +
                     ", double limit) {\n  return step_in<" + scene +
                     ">(data, stack, context, x, y, z, limit);\n}\n" + "extern \"C\" void " +
                     entry.relocate + "(NavigationStack* stack, " + data +
                     ", int blocked) {\n  relocate_in<" + scene +
                     ">(data, stack, context, x, y, z, blocked);\n}\n";
  if (entry.safety.empty()) return text;
  return text + "extern \"C\" double " + entry.safety + "(const NavigationStack* stack, " + data +
         ", double enough) {\n  return safety_in<" + scene +
         ">(data, stack, x, y, z, enough);\n}\n";
}

const std::string& common_text() {
  static const std::string text = make_common_text();
  return text;
}

std::string module_text(const std::string& title, const Shapes& shapes, const std::string& types,
                        const std::string& functions) {
  std::string text = common_text();
  for (const std::string_view kernel : kernel_order()) {
    // Constants are folded only into kernels that are inlined. Large kernels are not inlined,
    // because they would be inlined into one another again and again.
    if (!is_common(kernel) && shapes.kernels().contains(std::string(kernel))) {
      add_kernel(text, kernel, inlines_everywhere(kernel));
    }
  }
  return text + "\n// " + title +
         " Generated: do not edit.\n\nnamespace navjit::kernels {\nnamespace {\n\n" + types +
         "\n}  // namespace\n\n" + functions + "\n}  // namespace navjit::kernels\n";
}

}  // namespace navjit::codegen
