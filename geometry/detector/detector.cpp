#include "navjit/detector.hpp"

#include <algorithm>

#include "geometry/detector/touchables.hpp"
#include "geometry/model/world.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

/// The state at the end of a way down from the world volume; `choose(volume, i)` gives the number
/// of the daughter to take at level i.
template <class Choose>
State descend(const World& world, std::size_t levels, const Choose& choose) {
  VolumeId volume = world.top;
  TouchableId touchable = 0;
  for (std::size_t i = 0; i < levels; ++i) {
    const LogicalVolume& mother = world.volumes[volume];
    const Placement& placement = mother.daughters[choose(mother, i)];
    touchable += placement.offset;
    volume = placement.volume;
  }
  return {touchable, volume};
}

/// The element all[number]; throws UsageError, which names it by `what`, if there is none.
template <class T>
const T& at(const std::vector<T>& all, std::uint32_t number, const char* what) {
  if (number >= all.size()) {
    throw UsageError("the detector has no " + std::string(what) + " " + std::to_string(number));
  }
  return all[number];
}

}  // namespace

Detector::Detector(World world) : Detector(std::make_shared<const World>(std::move(world))) {}
Detector::Detector(std::shared_ptr<const World> world) : world_(std::move(world)) {
  require_finished(world_.get());
}

const State& Detector::checked(const State& state) const {
  check_state(*world_, state);
  return state;  // NOLINT(bugprone-return-const-ref-from-parameter): used in the same expression
}

std::size_t Detector::volumes() const { return world_->volumes.size(); }

VolumeId Detector::world_volume() const { return world_->top; }

const LogicalVolume& Detector::volume(VolumeId volume) const {
  return at(world_->volumes, volume, "volume");
}

std::optional<VolumeId> Detector::find_volume(std::string_view name) const {
  const auto& all = world_->volumes;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& volume) { return volume.name == name; });
  if (found == all.end()) return std::nullopt;
  return static_cast<VolumeId>(found - all.begin());
}

std::size_t Detector::materials() const { return world_->materials.size(); }

const Material& Detector::material(std::uint32_t material) const {
  return at(world_->materials, material, "material");
}

const Material& Detector::material(const LogicalVolume& volume) const {
  static const Material none{};
  return volume.material < world_->materials.size() ? world_->materials[volume.material] : none;
}

std::size_t Detector::elements() const { return world_->elements.size(); }

const Element& Detector::element(std::uint32_t element) const {
  return at(world_->elements, element, "element");
}

std::size_t Detector::isotopes() const { return world_->isotopes.size(); }

const Isotope& Detector::isotope(std::uint32_t isotope) const {
  return at(world_->isotopes, isotope, "isotope");
}

const Auxiliaries& Detector::auxiliaries() const { return world_->auxiliaries; }

double Detector::tolerance() const { return world_->tolerance; }
int Detector::levels() const { return world_->depth; }
TouchableId Detector::touchables() const { return world_->volumes[world_->top].touchables; }

int Detector::depth(const State& state) const {
  return static_cast<int>(levels_of(*world_, state).size()) - 1;
}

State Detector::mother(const State& state) const {
  const TouchableLevels levels = levels_of(*world_, state);
  return levels.size() < 2 ? State{} : levels[levels.size() - 2].state();
}

State Detector::ancestor(const State& state, int depth) const {
  const TouchableLevels levels = levels_of(*world_, state);
  if (depth < 0 || static_cast<std::size_t>(depth) >= levels.size()) {
    throw UsageError("the touchable has no ancestor at depth " + std::to_string(depth) +
                     ": its own is " + std::to_string(levels.size() - 1));
  }
  return levels[static_cast<std::size_t>(depth)].state();
}

const Placement* Detector::placement(const State& state) const {
  const TouchableLevels levels = levels_of(*world_, state);
  if (levels.size() < 2) return nullptr;
  return &world_->volumes[levels[levels.size() - 2].volume].daughters[levels.back().daughter];
}

int Detector::copy_number(const State& state) const {
  const Placement* const placed = placement(state);
  return placed == nullptr ? 0 : placed->copy_number;
}

Transformation Detector::frame(const State& state) const {
  return frame_of(*world_, levels_of(*world_, state));
}

std::string Detector::path_of(const State& state) const {
  return navjit::path_of(*world_, checked(state).touchable());
}

std::vector<std::uint32_t> Detector::path(const State& state) const {
  std::vector<std::uint32_t> path;
  const TouchableLevels levels = levels_of(*world_, state);
  for (std::size_t i = 1; i < levels.size(); ++i) path.push_back(levels[i].daughter);
  return path;
}

State Detector::state_at(std::span<const std::uint32_t> path) const {
  return descend(*world_, path.size(), [&](const LogicalVolume& mother, std::size_t i) {
    if (path[i] >= mother.daughters.size()) {
      throw UsageError("volume '" + mother.name + "' has no daughter number " +
                       std::to_string(path[i]));
    }
    return std::size_t{path[i]};
  });
}

State Detector::state_at(std::span<const NamedPlacement> path) const {
  return descend(*world_, path.size(), [&](const LogicalVolume& mother, std::size_t i) {
    const auto found = std::find_if(
        mother.daughters.begin(), mother.daughters.end(), [&](const Placement& placement) {
          return placement.name == path[i].name && placement.copy_number == path[i].copy_number;
        });
    if (found == mother.daughters.end()) {
      throw UsageError("volume '" + mother.name + "' has no placement '" + path[i].name +
                       "' with copy number " + std::to_string(path[i].copy_number));
    }
    return static_cast<std::size_t>(found - mother.daughters.begin());
  });
}

}  // namespace navjit
