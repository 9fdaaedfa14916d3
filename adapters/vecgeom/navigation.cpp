// The runtime, what VecGeom's volumes are given, and what they had before.
#include <VecGeom/management/GeoManager.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "adapters/vecgeom/navigator.hpp"
#include "adapters/vecgeom/world.hpp"
#include "navjit/vecgeom.hpp"

namespace navjit::vecgeom {
namespace {

using ::vecgeom::GeoManager;
using ::vecgeom::LogicalVolume;

const ::vecgeom::VPlacedVolume& world_of_manager() {
  const GeoManager& manager = GeoManager::Instance();
  if (manager.GetWorld() == nullptr || !manager.IsClosed())
    throw UsageError("VecGeom's GeoManager has no closed world: load one, or call CloseGeometry()");
  return *manager.GetWorld();
}

double checked_unit(double mm_per_unit) {
  const double mm = mm_per_unit == 0 ? 1 / GeoManager::GetMillimeterUnit() : mm_per_unit;
  if (!(mm > 0) || !std::isfinite(mm))
    throw UsageError("VecGeom's unit of length has to be a number of mm above 0");
  return mm;
}

}  // namespace

struct Navigation::Parts {
  explicit Parts(Options options)
      : mm(checked_unit(options.mm_per_unit)),
        world(convert(world_of_manager(), mm, options.material)),
        runtime(world.detector, std::move(options.runtime)),
        navigators(runtime),
        asked{world.paths, navigators, mm, 1 / mm},
        safety(asked, before),
        navigator(asked, before, safety) {}

  double mm;
  ConvertedWorld world;
  Runtime runtime;
  ThreadNavigators navigators;
  Asked asked;
  Before before;
  SafetyEstimator safety;
  StepNavigator navigator;
};

Navigation::Navigation(Options options) : parts_(std::make_unique<Parts>(std::move(options))) {}
Navigation::~Navigation() { detach(); }

void Navigation::attach() {
  std::vector<const LogicalVolume*> all;
  for (const auto& [volume, id] : parts_->world.volumes) all.push_back(volume);
  attach(all);
}

void Navigation::attach(std::span<const LogicalVolume* const> volumes) {
  std::vector<LogicalVolume*> own;
  const auto& registered = GeoManager::Instance().GetLogicalVolumesMap();
  for (const LogicalVolume* volume : volumes) {
    if (volume == nullptr || !parts_->world.volumes.contains(volume))
      throw UsageError("VecGeom's volume '" + (volume ? volume->GetLabel() : "(null)") +
                       "' is not in the world that navjit took over, or is an assembly");
    own.push_back(registered.at(volume->id()));
  }
  for (LogicalVolume* volume : own) {
    // What was remembered of it is of no use if others have changed it since.
    if (volume->GetNavigator() != &parts_->navigator)
      parts_->before.all.insert_or_assign(volume, Before::had(*volume));
    volume->SetNavigator(&parts_->navigator);
    volume->SetSafetyEstimator(&parts_->safety);
  }
}

void Navigation::detach() {
  // Volumes may no longer exist: they are looked up before a pointer to them is followed.
  for (const auto& [id, volume] : GeoManager::Instance().GetLogicalVolumesMap()) {
    const auto had = parts_->before.all.find(volume);
    if (had == parts_->before.all.end()) continue;
    if (volume->GetNavigator() == &parts_->navigator) volume->SetNavigator(had->second.navigator);
    if (volume->GetSafetyEstimator() == &parts_->safety)
      volume->SetSafetyEstimator(had->second.safety);
  }
  parts_->before.all.clear();
}

const ::vecgeom::VNavigator& Navigation::navigator() const { return parts_->navigator; }
const ::vecgeom::VSafetyEstimator& Navigation::safety_estimator() const { return parts_->safety; }

bool Navigation::locate(const Vector& point, const Vector& direction,
                        NavigationState& state) const {
  Navigator& navigator = parts_->navigators.mine();
  const State found = navigator.locate(parts_->asked.point(point), Asked::direction(direction));
  state.Clear();
  parts_->world.paths.write(state, State{}, navigator.levels(), state);
  return found.inside();
}

State Navigation::state(const NavigationState& state) const {
  return parts_->world.paths.state(state);
}

void Navigation::write(const State& state, NavigationState& out) const {
  const Paths& paths = parts_->world.paths;
  out.Clear();
  if (!state.inside()) return;
  Paths::push(out, paths.world);
  VolumeId mother = detector().world_volume();
  for (const std::uint32_t daughter : detector().path(state)) {
    paths.push_daughter(out, mother, daughter);
    mother = detector().volume(mother).daughters[daughter].volume;
  }
  paths.forget_last_exited(out);
}

std::optional<VolumeId> Navigation::volume(const LogicalVolume& volume) const {
  const auto found = parts_->world.volumes.find(&volume);
  if (found == parts_->world.volumes.end()) return std::nullopt;
  return found->second;
}

const std::vector<std::string>& Navigation::empty_volumes() const { return parts_->world.empty; }
double Navigation::mm_per_unit() const { return parts_->mm; }
const Detector& Navigation::detector() const { return parts_->world.detector; }
Runtime& Navigation::runtime() { return parts_->runtime; }

}  // namespace navjit::vecgeom
