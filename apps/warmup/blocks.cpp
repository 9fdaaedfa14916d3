#include "apps/warmup/blocks.hpp"

#include <algorithm>
#include <bit>

namespace navjit::warmup {
namespace {

constexpr int in_a_doubling = 32;  // blocks, until the number of chunks has doubled

/// Spreads each bit over all of them (the finaliser of SplitMix64), so that errors of several
/// chunks do not cancel in the sum.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

}  // namespace

std::size_t block_of(std::uint64_t chunk) {
  const int doublings = std::max(0, static_cast<int>(std::bit_width(chunk / in_a_doubling)) - 1);
  return static_cast<std::size_t>(in_a_doubling * doublings) +
         static_cast<std::size_t>(chunk >> doublings);
}

std::uint64_t chunks_in(std::size_t block) {
  const std::size_t doublings = block < in_a_doubling ? 0 : block / in_a_doubling - 1;
  return std::uint64_t{1} << doublings;
}

void Blocks::add(std::uint64_t chunk, std::uint64_t steps, double length) {
  const std::size_t block = block_of(chunk);
  if (block >= most_blocks) return;
  Sum& sum = sums_[block];
  sum.steps += steps;
  sum.lengths += spread_bits(std::bit_cast<std::uint64_t>(length) + chunk);
  ++sum.chunks;
}

std::vector<Block> Blocks::complete() const {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < most_blocks && sums_[i].chunks == chunks_in(i); ++i) {
    blocks.push_back({sums_[i].steps, sums_[i].lengths});
  }
  return blocks;
}

}  // namespace navjit::warmup
