#include "runtime/table.hpp"

#include <algorithm>

#include "geometry/navigation/generic.hpp"

namespace navjit {

NavigatorTable::NavigatorTable(const Geometry& geometry)
    : size_(geometry.size()), entries_(std::make_unique<Entry[]>(size_)), owners_(size_) {
  for (std::size_t v = 0; v < size_; ++v) {
    entries_[v].store(&generic::navigators, std::memory_order_relaxed);
  }
  // Generated code reads the entries through __atomic_load_n: the same object representation.
  context_ = {reinterpret_cast<const kernels::Navigators* const*>(entries_.get()), &geometry};
}

void NavigatorTable::install(VolumeId volume, const kernels::Navigators* record,
                             std::shared_ptr<const void> owner) {
  const std::lock_guard lock(mutex_);
  entries_[volume].store(record, std::memory_order_release);
  std::swap(owners_[volume], owner);
  if (owner) graveyard_.retire(std::move(owner), threads_);
}

void NavigatorTable::reset(VolumeId volume) { install(volume, &generic::navigators, nullptr); }

std::shared_ptr<Presence> NavigatorTable::add_thread() {
  const std::lock_guard lock(mutex_);
  return threads_.emplace_back(std::make_shared<Presence>());
}

void NavigatorTable::remove_thread(const std::shared_ptr<Presence>& thread) {
  const std::lock_guard lock(mutex_);
  std::erase(threads_, thread);
}

std::size_t NavigatorTable::sweep() {
  const std::lock_guard lock(mutex_);
  return graveyard_.sweep();
}

}  // namespace navjit
