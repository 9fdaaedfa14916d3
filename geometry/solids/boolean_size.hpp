// What a boolean that a file asks for will be made of, known before it is made: long chains are few
// levels once made (geometry/solids/boolean.cpp), deep nests are not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navjit {

/// A union of unions is made as one balanced tree, and so is what is cut from one solid in turn:
/// what such a chain is made of, whose levels are far fewer than its links.
struct BooleanChain {
  bool subtraction = false;
  std::size_t first_depth = 0;   ///< levels of what is cut, for a subtraction
  std::size_t joined = 1;        ///< solids that are united, or cut away
  std::size_t joined_depth = 1;  ///< levels of the deepest of them

  std::size_t depth() const {
    std::size_t depth = joined_depth;
    for (std::size_t n = 1; n < joined; n *= 2) ++depth;
    return subtraction ? 1 + std::max(first_depth, depth) : depth;
  }
};

/// Of a primitive, unless more is known.
struct BooleanSize {
  std::size_t depth = 1;                ///< levels of booleans as made, 1 for a primitive
  std::size_t parts = 1;                ///< primitives it is made of
  std::size_t links = 1;                ///< levels of booleans as written
  std::optional<BooleanChain> chain{};  ///< of unions and subtractions
};

enum class Boolean : std::uint8_t { join, cut, meet };

/// Of the boolean of two solids. One that is moved within it is a solid of its own: it goes on with
/// no chain.
BooleanSize size_of(Boolean kind, const BooleanSize& a, bool a_moved, const BooleanSize& b,
                    bool b_moved);

/// What the booleans of a file may be, as its reader's options have it.
struct BooleanLimits {
  std::size_t depth, chain, parts;
  std::string_view owner;       ///< what they are members of: "GdmlLimits"
  std::string_view than_chain;  ///< what the format has in place of chains: "use a multiUnion"
};

/// What is wrong with a boolean that is about to be made, and what to do; empty for nothing.
/// `parts_in_all`: of all booleans of the file so far, to which those of this one are added.
std::string excess(const BooleanSize& size, const BooleanLimits& limits, std::size_t& parts_in_all);

}  // namespace navjit
