// The types of searches as text, and their numbers except for tables.
#pragma once

#include <string>

#include "codegen/data/parts.hpp"

namespace navjit::codegen {

// Each overload spells the type of one search, in namespace navjit::kernels.
std::string type_of(const kernels::NoSearch& search);
std::string type_of(const kernels::SearchAll& search);
std::string type_of(const Lanes<1>& search);
std::string type_of(const Lanes<2>& search);
std::string type_of(const kernels::SearchSlabs<Index>& search);
std::string type_of(const kernels::SearchGrid<Index>& search);
std::string type_of(const kernels::SearchBoxes<Index>& search);
std::string type_of(const kernels::SearchScan& search);
std::string type_of(const kernels::SearchNest<Index>& search);
std::string type_of(const kernels::SearchRings<Index>& search);

// Each overload writes one search as an initialiser, with null for its tables
// (kernels::with_tables); nothing if it has no numbers that are constants.
std::string numbers_of_search(const kernels::NoSearch& search);
std::string numbers_of_search(const kernels::SearchAll& search);
std::string numbers_of_search(const Lanes<1>& search);
std::string numbers_of_search(const Lanes<2>& search);
std::string numbers_of_search(const kernels::SearchSlabs<Index>& search);
std::string numbers_of_search(const kernels::SearchGrid<Index>& search);
std::string numbers_of_search(const kernels::SearchBoxes<Index>& search);
std::string numbers_of_search(const kernels::SearchScan& search);
std::string numbers_of_search(const kernels::SearchNest<Index>& search);
std::string numbers_of_search(const kernels::SearchRings<Index>& search);

}  // namespace navjit::codegen
