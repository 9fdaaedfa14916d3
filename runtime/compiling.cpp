#include "runtime/compiling.hpp"

namespace navjit {

Compiling::Compiling(Specialisation& spec, const std::set<VolumeId>& volumes) : spec_(spec) {
  const std::lock_guard lock(spec_.mutex);
  for (const VolumeId volume : volumes) {
    SceneStatus& status = spec_.scenes[volume].status;
    before_.emplace_back(volume, status);
    status = SceneStatus::compiling;
  }
}

Compiling::~Compiling() {
  const std::lock_guard lock(spec_.mutex);
  if (spec_.stopping()) return;
  for (const auto& [volume, status] : before_) {
    // A trial may have changed the status meanwhile.
    SceneStatus& now = spec_.scenes[volume].status;
    if (now == SceneStatus::compiling) now = status;
  }
}

}  // namespace navjit
