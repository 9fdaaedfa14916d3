// The dispatch table: for each volume, one atomic pointer to an immutable dispatch entry.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "geometry/navigation/geometry.hpp"
#include "runtime/reclamation.hpp"

namespace navjit {

/// Readers take no lock (kernels::dispatch_entry_of). Only one thread may write at a time.
class DispatchTable {
 public:
  /// Every volume starts with the generic navigator.
  explicit DispatchTable(const Geometry& geometry);

  const kernels::Context& context() const { return context_; }
  const kernels::DispatchEntry* at(VolumeId volume) const {
    return entries_[volume].load(std::memory_order_acquire);
  }
  /// Installs an entry for a volume; `owner` keeps the entry and its code alive while they are in
  /// use.
  void install(VolumeId volume, const kernels::DispatchEntry* record,
               std::shared_ptr<const void> owner);
  /// Keeps `owner` alive as long as the table.
  void keep(std::shared_ptr<const void> owner);
  /// Shows a navigator of the volume for the time being. It is the installed one, or one that has
  /// another owner.
  void show(VolumeId volume, const kernels::DispatchEntry* record) {
    entries_[volume].store(record, std::memory_order_release);
  }
  /// Back to the generic navigator.
  void reset(VolumeId volume);
  /// Since when the volume has had navigators other than the generic one, by steady_seconds(); 0 if
  /// it has the generic one.
  double specialised_since(VolumeId volume) const;

  /// A thread that will navigate with this table must register itself.
  std::shared_ptr<ReadSide> add_thread();
  void remove_thread(const std::shared_ptr<ReadSide>& thread);

  /// Frees replaced code that no thread can be using; returns how many entries still wait.
  std::size_t reclaim();

  /// The table's mutex, which has to be locked during a fork().
  std::mutex& mutex() const { return mutex_; }

 private:
  using Entry = std::atomic<const kernels::DispatchEntry*>;
  static_assert(Entry::is_always_lock_free && sizeof(Entry) == sizeof(void*));

  std::size_t size_;
  std::unique_ptr<Entry[]> entries_;
  std::vector<VolumeId> volumes_;  ///< daughters of all volumes, one volume after the other
  std::vector<const VolumeId*> daughters_;  ///< by volume: where its daughters begin in volumes_
  kernels::Context context_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::vector<double> specialised_since_;
  std::vector<std::shared_ptr<const void>> owners_, kept_;
  std::vector<std::shared_ptr<ReadSide>> threads_;
  RetireList retired_;
};

}  // namespace navjit
