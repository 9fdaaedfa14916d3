#include "adapters/vecgeom/threads.hpp"

#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

namespace navjit::vecgeom {

struct ThreadNavigators::Pool {
  explicit Pool(Runtime& of) : runtime(&of) {}

  Runtime* runtime;
  std::mutex mutex{};
  std::vector<std::unique_ptr<Navigator>> all{};
  std::vector<Navigator*> waiting{};  ///< of threads that have ended

  Navigator& lease() {
    const std::lock_guard lock(mutex);
    if (waiting.empty())
      return *all.emplace_back(std::make_unique<Navigator>(runtime->navigator()));
    Navigator* const one = waiting.back();
    waiting.pop_back();
    return *one;
  }
  void give_back(Navigator& one) {
    const std::lock_guard lock(mutex);
    waiting.push_back(&one);
  }
};

/// The navigators that a thread has from all pools; it gives them back when it ends.
struct ThreadNavigators::Leases {
  struct Lease {
    std::uint64_t owner;
    std::weak_ptr<Pool> pool;
    Navigator* navigator;
  };
  std::vector<Lease> all{};

  Leases() = default;
  Leases(const Leases&) = delete;
  Leases& operator=(const Leases&) = delete;
  ~Leases() {
    last = {};
    for (const Lease& lease : all) {
      if (const auto pool = lease.pool.lock()) pool->give_back(*lease.navigator);
    }
  }
};

ThreadNavigators::Leases& ThreadNavigators::leases() {
  static thread_local Leases own;
  return own;
}

ThreadNavigators::ThreadNavigators(Runtime& runtime) : pool_(std::make_shared<Pool>(runtime)) {
  static std::atomic<std::uint64_t> numbers = 0;
  number_ = ++numbers;
}

ThreadNavigators::~ThreadNavigators() = default;

Navigator& ThreadNavigators::find() const {
  Leases& own = leases();
  std::erase_if(own.all, [](const Leases::Lease& lease) { return lease.pool.expired(); });
  for (const Leases::Lease& lease : own.all) {
    if (lease.owner == number_) {
      last = {number_, lease.navigator};
      return *lease.navigator;
    }
  }
  own.all.reserve(own.all.size() + 1);  // if this throws, no navigator is lost
  Navigator& navigator = pool_->lease();
  own.all.push_back({number_, pool_, &navigator});
  last = {number_, &navigator};
  return navigator;
}

}  // namespace navjit::vecgeom
