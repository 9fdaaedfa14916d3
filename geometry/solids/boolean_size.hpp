// How large a boolean of a file will be, known before it is made: long chains have few levels once
// they are made (geometry/solids/boolean.cpp), deep nests do not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace navjit {

/// What a chain is made of. A union of unions is made as one balanced tree, and so is all that is
/// cut from one solid in turn: such a chain has far fewer levels than links.
struct BooleanChain {
  bool subtraction = false;
  std::size_t first_depth = 0;   ///< for a subtraction: the levels of what is cut
  std::size_t joined = 1;        ///< solids that are united, or cut away
  std::size_t joined_depth = 1;  ///< levels of the deepest of them

  std::size_t depth() const {
    std::size_t depth = joined_depth;
    for (std::size_t n = 1; n < joined; n *= 2) ++depth;
    return subtraction ? 1 + std::max(first_depth, depth) : depth;
  }
};

/// The size of a primitive, unless other values are set.
struct BooleanSize {
  std::size_t depth = 1;                ///< levels of booleans once made, 1 for a primitive
  std::size_t parts = 1;                ///< the primitives that it is made of
  std::size_t links = 1;                ///< levels of booleans as written
  std::optional<BooleanChain> chain{};  ///< for unions and subtractions
};

enum class Boolean : std::uint8_t { join, cut, meet };

/// The size of the boolean of two solids. A union goes on in a union that it is an operand of,
/// moved or not. A subtraction goes on where more is cut from it, unless it is moved before
/// (`a_moved`).
BooleanSize size_of(Boolean kind, const BooleanSize& a, bool a_moved, const BooleanSize& b);

/// How large the booleans of a file may be, by the options of its reader.
struct BooleanLimits {
  std::size_t depth, chain, parts;
  std::string_view owner;       ///< the name of the options in messages: "GdmlLimits"
  std::string_view than_chain;  ///< what the format offers instead of chains: "use a multiUnion"
};

/// What is wrong with a boolean that is about to be made, and what to do; empty if nothing is. Adds
/// its parts to `parts_in_all`, which are those of all booleans of the file so far.
std::string excess(const BooleanSize& size, const BooleanLimits& limits, std::size_t& parts_in_all);

}  // namespace navjit
