#include "runtime/dispatch_table.hpp"

#include <algorithm>

#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/steps_of_no_length.hpp"
#include "geometry/navigation/thread_sanitizer.hpp"
#include "runtime/steady_seconds.hpp"

namespace navjit {

DispatchTable::DispatchTable(const Geometry& geometry)
    : size_(geometry.size()),
      entries_(std::make_unique<Entry[]>(size_)),
      specialised_since_(size_),
      owners_(size_) {
  for (std::size_t v = 0; v < size_; ++v) {
    entries_[v].store(&generic::dispatch_entry, std::memory_order_relaxed);
  }
  for (VolumeId v = 0; v < size_; ++v) {
    for (const Daughter& d : geometry.scene(v).daughters) volumes_.push_back(d.volume);
  }
  const VolumeId* first = volumes_.data();
  for (VolumeId v = 0; v < size_; ++v) {
    daughters_.push_back(first);
    first += geometry.scene(v).daughters.size();
  }
  // Generated code reads the entries through __atomic_load_n: std::atomic of a pointer has the same
  // object representation.
  context_ = {reinterpret_cast<const kernels::DispatchEntry* const*>(entries_.get()), &geometry,
              leave_at_once, return_at_once, daughters_.data()};
}

void DispatchTable::install(VolumeId volume, const kernels::DispatchEntry* record,
                            std::shared_ptr<const void> owner) {
  const std::lock_guard lock(mutex_);
  tell_published(record->data);
  entries_[volume].store(record, std::memory_order_release);
  double& since = specialised_since_[volume];
  if (record == &generic::dispatch_entry) {
    since = 0;
  } else if (since == 0) {
    since = steady_seconds();
  }
  std::swap(owners_[volume], owner);
  if (owner) retired_.retire(std::move(owner), threads_);
}

void DispatchTable::keep(std::shared_ptr<const void> owner) {
  const std::lock_guard lock(mutex_);
  kept_.push_back(std::move(owner));
}

void DispatchTable::reset(VolumeId volume) { install(volume, &generic::dispatch_entry, nullptr); }

double DispatchTable::specialised_since(VolumeId volume) const {
  const std::lock_guard lock(mutex_);
  return specialised_since_[volume];
}

std::shared_ptr<ReadSide> DispatchTable::add_thread() {
  const std::lock_guard lock(mutex_);
  return threads_.emplace_back(std::make_shared<ReadSide>());
}

void DispatchTable::remove_thread(const std::shared_ptr<ReadSide>& thread) {
  const std::lock_guard lock(mutex_);
  std::erase(threads_, thread);
}

std::size_t DispatchTable::reclaim() {
  const std::lock_guard lock(mutex_);
  return retired_.reclaim();
}

}  // namespace navjit
