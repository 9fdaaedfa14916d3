#include "codegen/search_numbers.hpp"

#include "codegen/text.hpp"

namespace navjit::codegen {
namespace {

using namespace kernels;

template <class Grid>
std::string of_grid(const Grid& g) {
  return "{{" + list(g.count) + ", " + list(g.origin) + ", " + list(g.width) + ", " +
         list(g.per_mm) + "}}";
}

std::string of_beside(const Beside<Index>& b) {
  return "{nullptr, " + number(b.few_count) + ", nullptr, nullptr, " + number(b.block_count) + "}";
}

}  // namespace

std::string type_of(const NoSearch&) { return "NoSearch"; }
std::string type_of(const SearchAll&) { return "SearchAll"; }
std::string type_of(const Lanes<1>&) { return "SearchLanes<FoursAt<1>>"; }
std::string type_of(const Lanes<2>&) { return "SearchLanes<FoursAt<2>>"; }
std::string type_of(const SearchSlabs<Index>&) { return "SearchSlabs<unsigned>"; }
std::string type_of(const SearchGrid<Index>&) { return "SearchGrid<unsigned>"; }
std::string type_of(const SearchBoxes<Index>&) { return "SearchBoxes<unsigned>"; }
std::string type_of(const SearchScan&) { return "SearchScan"; }
std::string type_of(const SearchNest<Index>&) { return "SearchNest<unsigned>"; }
std::string type_of(const SearchRings<Index>&) { return "SearchRings<unsigned>"; }

std::string numbers_of_search(const NoSearch&) { return {}; }
std::string numbers_of_search(const SearchAll&) { return {}; }
std::string numbers_of_search(const Lanes<1>&) { return {}; }
std::string numbers_of_search(const Lanes<2>&) { return {}; }

std::string numbers_of_search(const SearchSlabs<Index>& search) {
  const SlabRow<Index>& s = search.slabs;
  return "{{" + number(s.count) + ", nullptr, nullptr, nullptr, nullptr, " + number(s.skin) + ", " +
         number(s.origin) + ", " + number(s.per_mm) + ", " + number(s.cells) +
         ", nullptr, nullptr}, " + number(search.axis) + "}";
}
std::string numbers_of_search(const SearchGrid<Index>& search) { return of_grid(search.grid); }
std::string numbers_of_search(const SearchBoxes<Index>& search) { return of_grid(search.grid); }
std::string numbers_of_search(const SearchScan& search) {
  return "{nullptr, " + number(search.count) + "}";
}
std::string numbers_of_search(const SearchNest<Index>& search) {
  const ShellNest<Index>& s = search.shells;
  return "{{" + number(s.count) + ", nullptr, nullptr, nullptr, " + number(s.ends) + ", " +
         number(s.low) + ", " + number(s.high) + "}, " + of_beside(search.beside) + ", " +
         number(search.axis) + "}";
}
std::string numbers_of_search(const SearchRings<Index>& search) {
  return "{nullptr, " + number(search.count) + ", " + of_beside(search.beside) + ", " +
         number(search.axis) + "}";
}

}  // namespace navjit::codegen
