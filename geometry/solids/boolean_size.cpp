#include "geometry/solids/boolean_size.hpp"

namespace navjit {
namespace {

/// The parts of all booleans of a file, in each that they are in: they take a second or two.
constexpr std::size_t most_parts_in_all = 5'000'000;

/// What a union or subtraction adds to the chains of its operands.
BooleanChain chain_of(const BooleanSize& a, bool a_moved, const BooleanSize& b, bool subtraction) {
  // A union that is moved is the union of its moved parts.
  const auto united = [](const BooleanSize& s) {
    return s.chain && !s.chain->subtraction ? *s.chain : BooleanChain{.joined_depth = s.depth};
  };
  const auto join = [](const BooleanChain& x, const BooleanChain& y) {
    return BooleanChain{.joined = x.joined + y.joined,
                        .joined_depth = std::max(x.joined_depth, y.joined_depth)};
  };
  BooleanChain chain = united(b);
  if (!subtraction) return join(united(a), chain);
  const bool goes_on = a.chain && a.chain->subtraction && !a_moved;
  if (goes_on) chain = join(*a.chain, chain);
  chain.subtraction = true;
  chain.first_depth = goes_on ? a.chain->first_depth : a.depth;
  return chain;
}

}  // namespace

BooleanSize size_of(Boolean kind, const BooleanSize& a, bool a_moved, const BooleanSize& b) {
  BooleanSize result;
  if (kind == Boolean::meet) {
    result.depth = 1 + std::max(a.depth, b.depth);
  } else {
    result.chain = chain_of(a, a_moved, b, kind == Boolean::cut);
    result.depth = result.chain->depth();
  }
  result.links = 1 + std::max(a.links, b.links);
  result.parts = a.parts + b.parts;
  return result;
}

std::string excess(const BooleanSize& size, const BooleanLimits& limits,
                   std::size_t& parts_in_all) {
  const auto raise = [&](const char* member) {
    return ", or raise " + std::string(limits.owner) + "::" + member;
  };
  if (size.depth > limits.depth) {
    return "booleans are nested more than " + std::to_string(limits.depth) +
           " deep; split the solid" + raise("max_solid_depth");
  }
  if (size.links > limits.chain) {
    return "more than " + std::to_string(limits.chain) + " booleans are chained; " +
           std::string(limits.than_chain) + raise("max_solid_chain");
  }
  // Every link of a chain is made anew from all its parts.
  if ((parts_in_all += size.parts) > most_parts_in_all) {
    return "the file's booleans are made of too many parts in all; " +
           std::string(limits.than_chain);
  }
  if (size.parts > limits.parts) {
    return "the boolean has more than " + std::to_string(limits.parts) + " parts; split the solid" +
           raise("max_solid_parts");
  }
  return {};
}

}  // namespace navjit
