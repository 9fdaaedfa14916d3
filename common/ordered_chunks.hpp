// Pieces of work that threads take as they come, and whose results are used in order.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace navjit::common {

/// At most `window` pieces are taken and not yet used, so that memory does not grow with their
/// number. All functions may be called from any thread; `next` and `use` are called by one at a
/// time.
template <class Work, class Result>
class OrderedChunks {
 public:
  struct Piece {
    std::uint64_t number;
    Work work;
  };

  /// `next` makes the next piece, or none at the end; `use` gets the results in the order of the
  /// pieces. What they throw comes out of take() and give().
  OrderedChunks(std::uint64_t window, std::function<std::optional<Work>()> next,
                std::function<void(Result&&)> use)
      : window_(window), next_(std::move(next)), use_(std::move(use)) {}

  /// A piece of work; waits while too many are under way. None at the end, or after stop().
  std::optional<Piece> take() {
    std::unique_lock lock(mutex_);
    moved_.wait(lock, [&] { return ended_ || taken_ < used_ + window_; });
    if (ended_) return std::nullopt;
    std::optional<Work> work = next_();
    if (!work) {
      ended_ = true;
      moved_.notify_all();
      return std::nullopt;
    }
    return Piece{taken_++, *std::move(work)};
  }

  /// What became of a piece. One that is not `complete` is the last that is used.
  void give(std::uint64_t number, Result result, bool complete = true) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(number, std::pair(std::move(result), complete));
    while (!cut_ && !waiting_.empty() && waiting_.begin()->first == used_) {
      auto ready = std::move(waiting_.extract(waiting_.begin()).mapped());
      ++used_;
      cut_ = !ready.second;
      use_(std::move(ready.first));
    }
    if (cut_) ended_ = true;
    moved_.notify_all();
  }

  /// No more pieces are given out.
  void stop() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    moved_.notify_all();
  }

 private:
  const std::uint64_t window_;
  const std::function<std::optional<Work>()> next_;
  const std::function<void(Result&&)> use_;
  std::mutex mutex_;
  std::condition_variable moved_;
  std::uint64_t taken_ = 0, used_ = 0;
  bool ended_ = false;  ///< no piece is given out any more
  bool cut_ = false;    ///< no result is used any more
  std::map<std::uint64_t, std::pair<Result, bool>> waiting_;
};

}  // namespace navjit::common
