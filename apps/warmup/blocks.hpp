// What a run keeps of its rays, so that runs can be compared: totals of blocks of rays, in little
// memory however long the run is.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace navjit::warmup {

/// Rays are dealt to threads in chunks.
constexpr std::uint64_t rays_per_chunk = 64;

// A block is one chunk at the beginning, and the later the more: no more than a thirty-second part
// of the chunks before it. So a run that ends within a block loses little of the comparison.

/// Later chunks are not kept; a run of an hour on a thousand threads does not get there.
constexpr std::size_t most_blocks = 1024;
/// The block that a chunk is in.
std::size_t block_of(std::uint64_t chunk);
/// The number of chunks in a block.
std::uint64_t chunks_in(std::size_t block);

/// Totals that do not depend on the order in which threads add to them.
struct Block {
  std::uint64_t steps = 0;
  std::uint64_t lengths = 0;  ///< a digest of all bits of the lengths of its chunks
  friend bool operator==(const Block&, const Block&) = default;
};

/// Collects blocks while threads make their rays.
class Blocks {
 public:
  /// A chunk that is complete, with the sum of its rays' lengths. From any thread.
  void add(std::uint64_t chunk, std::uint64_t steps, double length);
  /// The blocks that are complete, up to the first that is not. Once all threads have ended.
  std::vector<Block> complete() const;

 private:
  struct Sum {
    std::atomic<std::uint64_t> chunks{0}, steps{0}, lengths{0};
  };
  std::unique_ptr<Sum[]> sums_ = std::make_unique<Sum[]>(most_blocks);
};

}  // namespace navjit::warmup
