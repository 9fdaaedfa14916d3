#include "codegen/kernel_names.hpp"

#include <algorithm>
#include <array>

#include "geometry/solids/kinds.hpp"

namespace navjit::codegen {
namespace {

constexpr std::array of_scenes{
    "apart",      "grid",         "boxes",     "four_boxes",        "slabs",
    "nest",       "rings",        "wires",     "navigation_stack",  "navigation",
    "frames",     "bound_solids", "constants", "daughters",         "classes",
    "search_few", "searches",     "scan",      "constant_searches", "neighbour_list"};

}  // namespace

std::span<const char* const> scene_kernels() { return of_scenes; }

std::span<const char* const> kernels_of(SolidKind kind) { return facts_of(kind).kernel_files; }

std::string shape_type(SolidKind kind) { return facts_of(kind).shape; }

std::vector<std::string_view> kernel_order() {
  std::vector<std::string_view> order;
  for (const KindFacts& kind : all_kinds()) {
    for (const char* file : kind.kernel_files) {
      if (std::find(order.begin(), order.end(), file) == order.end()) order.emplace_back(file);
    }
  }
  return order;
}

bool inlines_everywhere(std::string_view kernel) {
  constexpr std::array<std::string_view, 11> small{"convex", "faces", "box",     "trd",
                                                   "trap",   "cone",  "boolean", "boolean_paths",
                                                   "wedge",  "tube",  "orb"};
  return std::find(small.begin(), small.end(), kernel) != small.end();
}

}  // namespace navjit::codegen
