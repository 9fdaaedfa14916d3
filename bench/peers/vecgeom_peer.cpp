#include "vecgeom_peer.hpp"

#include <VecGeom/gdml/Frontend.h>
#include <VecGeom/management/ABBoxManager.h>
#include <VecGeom/management/BVHManager.h>
#include <VecGeom/management/GeoManager.h>
#include <VecGeom/management/HybridManager2.h>
#include <VecGeom/navigation/BVHLevelLocator.h>
#include <VecGeom/navigation/BVHNavigator.h>
#include <VecGeom/navigation/BVHSafetyEstimator.h>
#include <VecGeom/navigation/GlobalLocator.h>
#include <VecGeom/navigation/HybridLevelLocator.h>
#include <VecGeom/navigation/HybridNavigator2.h>
#include <VecGeom/navigation/HybridSafetyEstimator.h>
#include <VecGeom/navigation/NavStatePool.h>
#include <VecGeom/navigation/NewSimpleNavigator.h>
#include <VecGeom/navigation/SimpleABBoxLevelLocator.h>
#include <VecGeom/navigation/SimpleABBoxNavigator.h>
#include <VecGeom/navigation/SimpleABBoxSafetyEstimator.h>
#include <VecGeom/navigation/SimpleSafetyEstimator.h>
#include <VecGeom/volumes/LogicalVolume.h>
#include <VecGeom/volumes/PlacedVolume.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string_view>
#include <utility>

namespace navjit::peers {
namespace {

using vecgeom::LogicalVolume;
using vecgeom::NavigationState;
using Vector = vecgeom::Vector3D<vecgeom::Precision>;

constexpr std::uint32_t no_volume = UINT32_MAX;
constexpr int zero_steps_allowed = 100;

/// Takes what is written to std::cout and std::cerr while it lives.
class Capture {
 public:
  Capture() : cout_(std::cout.rdbuf(text_.rdbuf())), cerr_(std::cerr.rdbuf(text_.rdbuf())) {}
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  ~Capture() {
    std::cout.rdbuf(cout_);
    std::cerr.rdbuf(cerr_);
  }

  /// The first line written.
  std::string first_line() const {
    std::istringstream in(text_.str());
    std::string line;
    while (std::getline(in, line) && line.empty()) {
    }
    return line;
  }

 private:
  std::ostringstream text_;
  std::streambuf* cout_;
  std::streambuf* cerr_;
};

/// The first element in the text that VecGeom's reader skips silently, or null. Entities are not
/// looked into.
const char* dropped_element(const std::string& text) {
  static constexpr const char* names[] = {"divisionvol", "replicavol", "paramvol",
                                          "loop",        "variable",   "quantity"};
  std::string_view rest = text;
  while (true) {
    const auto open = rest.find('<');
    if (open == std::string_view::npos) return nullptr;
    rest.remove_prefix(open + 1);
    if (rest.starts_with("!--")) {
      const auto close = rest.find("-->");
      if (close == std::string_view::npos) return nullptr;
      rest.remove_prefix(close);
      continue;
    }
    for (const char* name : names) {
      const std::string_view wanted = name;
      if (rest.starts_with(wanted) && rest.size() > wanted.size() &&
          std::string_view(" \t\r\n/>").find(rest[wanted.size()]) != std::string_view::npos)
        return name;
    }
  }
}

Vector to_vector(const double (&v)[3]) { return Vector(v[0], v[1], v[2]); }

/// A navigation state on the heap.
class OwnedState {
 public:
  explicit OwnedState(int depth) : state_(NavigationState::MakeInstance(depth)) {}
  OwnedState(const OwnedState&) = delete;
  OwnedState& operator=(const OwnedState&) = delete;
  ~OwnedState() { NavigationState::ReleaseInstance(state_); }

  NavigationState* get() const { return state_; }

 private:
  NavigationState* state_;
};

/// Makes a state forget which volume was left last, by the entry below its top: afterwards this
/// names a volume that nothing contains. VecGeom remembers it so as not to enter the volume again
/// at distance zero. But it remembers the placement and not the touchable, so that rays would pass
/// unseen through neighbours that are copies of each other. To forget takes no measurable time, but
/// makes more zero steps.
void forget_last_exited(NavigationState& state, const vecgeom::VPlacedVolume* world) {
  state.SetValueAt(state.GetCurrentLevel(), NavigationState::ToIndex(world));
}

/// Carries rays through the world. Calls `record(ray, volume, length)` for every step, and for a
/// ray that is stuck `give_up(ray, volume, zero_steps)`, after that many last steps of no length.
template <class Record, class GiveUp>
VecGeomPeer::Totals run(std::span<const Ray> rays, std::uint64_t max_steps, int depth,
                        Record&& record, GiveUp&& give_up) {
  const OwnedState first(depth);
  const OwnedState second(depth);
  const vecgeom::VPlacedVolume* world = vecgeom::GeoManager::Instance().GetWorld();
  VecGeomPeer::Totals totals;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    NavigationState* in = first.get();
    NavigationState* out = second.get();
    Vector position = to_vector(rays[i].position);
    const Vector direction = to_vector(rays[i].direction);
    in->Clear();
    vecgeom::GlobalLocator::LocateGlobalPoint(world, position, *in, true);
    forget_last_exited(*in, world);
    std::uint64_t steps = 0;
    int zero_steps = 0;
    while (!in->IsOutside()) {
      const LogicalVolume* volume = in->Top()->GetLogicalVolume();
      if (zero_steps >= zero_steps_allowed || steps == max_steps) {
        give_up(i, volume, zero_steps);
        ++totals.stuck;
        break;
      }
      const double step = volume->GetNavigator()->ComputeStepAndPropagatedState(
          position, direction, vecgeom::kInfLength, *in, *out);
      record(i, volume, step);
      ++steps;
      // VecGeom returns its tolerance as the step if it finds itself in the wrong volume.
      const bool zero = step <= vecgeom::kTolerance;
      zero_steps = zero ? zero_steps + 1 : 0;
      totals.zero_steps += zero ? 1 : 0;
      totals.length += step;
      position += step * direction;
      forget_last_exited(*out, world);
      std::swap(in, out);
    }
    totals.steps += steps;
  }
  return totals;
}

/// The navigator that a volume gets, by its number of daughters.
VecGeomNavigator choose(VecGeomNavigator navigator, std::size_t daughters) {
  if (daughters == 0) return VecGeomNavigator::simple;
  if (navigator == VecGeomNavigator::automatic) {
    navigator = daughters <= 4    ? VecGeomNavigator::simple
                : daughters <= 12 ? VecGeomNavigator::abbox
                                  : VecGeomNavigator::hybrid;
  }
  // These keep their candidates in arrays of fixed size, and do not check whether they fit.
  if (navigator == VecGeomNavigator::abbox && daughters > VECGEOM_MAXDAUGHTERS)
    navigator = VecGeomNavigator::hybrid;
  if (navigator == VecGeomNavigator::hybrid && daughters > VECGEOM_MAXFACETS)
    navigator = VecGeomNavigator::bvh;
  return navigator;
}

}  // namespace

struct VecGeomPeer::States::Impl {
  Impl(int size, int depth) : pool(size, depth) {}

  vecgeom::NavStatePool pool;
  std::vector<std::uint32_t> volumes;  // no_volume: outside
  std::size_t outside = 0;
  const LogicalVolume* common = nullptr;  // the volume of all points, if there is one
};

VecGeomPeer::States::States(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VecGeomPeer::States::States(States&&) noexcept = default;
VecGeomPeer::States& VecGeomPeer::States::operator=(States&&) noexcept = default;
VecGeomPeer::States::~States() = default;

std::size_t VecGeomPeer::States::size() const { return impl_->volumes.size(); }
std::size_t VecGeomPeer::States::outside() const { return impl_->outside; }
std::int64_t VecGeomPeer::States::volume(std::size_t i) const {
  return impl_->volumes[i] == no_volume ? -1 : std::int64_t{impl_->volumes[i]};
}

VecGeomPeer::~VecGeomPeer() = default;

Expected<std::unique_ptr<VecGeomPeer>> VecGeomPeer::load(const std::string& gdml_file) {
  static std::atomic<bool> loaded = false;
  if (loaded.exchange(true)) {
    return Failure{"VecGeom: a process can load only one geometry"};
  }
  {
    std::ifstream in(gdml_file, std::ios::binary);
    std::ostringstream copy;
    copy << in.rdbuf();  // unlike an iterator, does not throw on a directory
    const std::string text = std::move(copy).str();
    if (!in || text.empty()) return Failure{gdml_file + ": cannot be read"};
    if (const char* name = dropped_element(text)) {
      return Failure{gdml_file + ": VecGeom drops <" + name + "> elements"};
    }
  }

  auto& manager = vecgeom::GeoManager::Instance();
  {
    const Capture capture;
    bool good = false;
    std::string reason;
    try {
      // Validation would fetch the schema from the network; 1 stands for the length of a millimetre
      // (VecGeom's own choice is 0.1, centimetres).
      good = vgdml::Frontend::Load(gdml_file, false, 1.0, false);
    } catch (const std::exception& e) {
      reason = e.what();
    } catch (...) {
      reason = "exception in the reader";
    }
    if (!good || manager.GetWorld() == nullptr || !manager.IsClosed()) {
      if (reason.empty()) reason = capture.first_line();
      return Failure{gdml_file + ": VecGeom refuses it" + (reason.empty() ? "" : ": " + reason)};
    }
  }

  std::unique_ptr<VecGeomPeer> peer(new VecGeomPeer);
  peer->state_depth_ = manager.getMaxDepth() + 1;  // room for the entry below the deepest volume
  std::vector<const LogicalVolume*> volumes;
  manager.GetAllLogicalVolumes(volumes);
  for (const LogicalVolume* volume : volumes) {
    if (volume->id() >= peer->index_of_id_.size())
      peer->index_of_id_.resize(volume->id() + 1, no_volume);
    peer->index_of_id_[volume->id()] = static_cast<std::uint32_t>(peer->names_.size());
    peer->names_.push_back(volume->GetLabel());
  }
  peer->use(VecGeomNavigator::automatic);
  return peer;
}

void VecGeomPeer::use(VecGeomNavigator navigator) {
  struct Choice {
    LogicalVolume* volume;
    VecGeomNavigator navigator;
  };
  std::vector<Choice> choices;
  bool wants_hybrid = false;
  bool wants_bvh = false;
  for (const auto& [id, volume] : vecgeom::GeoManager::Instance().GetLogicalVolumesMap()) {
    if (id >= index_of_id_.size() || index_of_id_[id] == no_volume) continue;
    choices.push_back({volume, choose(navigator, volume->GetDaughters().size())});
    wants_hybrid = wants_hybrid || choices.back().navigator == VecGeomNavigator::hybrid;
    wants_bvh = wants_bvh || choices.back().navigator == VecGeomNavigator::bvh;
  }
  // Built once, since to build again leaks; the plain boxes exist since the geometry was closed.
  if (wants_hybrid && !has_hybrid_) {
    for (const Choice& choice : choices)
      vecgeom::HybridManager2::Instance().InitStructure(choice.volume);
    has_hybrid_ = true;
  }
  if (wants_bvh && !has_bvh_) {
    vecgeom::BVHManager::Init();
    has_bvh_ = true;
  }

  for (const Choice& choice : choices) {
    const vecgeom::VNavigator* chosen = vecgeom::NewSimpleNavigator<>::Instance();
    const vecgeom::VSafetyEstimator* safety = vecgeom::SimpleSafetyEstimator::Instance();
    const vecgeom::VLevelLocator* locator = vecgeom::SimpleABBoxLevelLocator::GetInstance();
    if (choice.navigator == VecGeomNavigator::abbox) {
      chosen = vecgeom::SimpleABBoxNavigator<>::Instance();
      safety = vecgeom::SimpleABBoxSafetyEstimator::Instance();
    } else if (choice.navigator == VecGeomNavigator::hybrid) {
      chosen = vecgeom::HybridNavigator<>::Instance();
      safety = vecgeom::HybridSafetyEstimator::Instance();
      // As measured, the flat list of boxes locates faster up to some hundreds of daughters.
      if (choice.volume->GetDaughters().size() > 400)
        locator = vecgeom::THybridLevelLocator<>::GetInstance();
    } else if (choice.navigator == VecGeomNavigator::bvh) {
      chosen = vecgeom::BVHNavigator<>::Instance();
      safety = vecgeom::BVHSafetyEstimator::Instance();
      locator = vecgeom::BVHLevelLocator::GetInstance();
    }
    if (choice.volume->ContainsAssembly())
      locator = vecgeom::SimpleAssemblyAwareABBoxLevelLocator::GetInstance();
    choice.volume->SetNavigator(chosen);
    choice.volume->SetSafetyEstimator(safety);
    choice.volume->SetLevelLocator(locator);
  }
}

std::vector<Segment> VecGeomPeer::trace(std::span<const Ray> rays,
                                        std::uint64_t max_steps_per_ray) const {
  std::vector<Segment> segments;
  const auto record = [&](std::size_t ray, const LogicalVolume* volume, double length) {
    segments.push_back({static_cast<std::uint32_t>(ray), index_of_id_[volume->id()], length});
  };
  run(rays, max_steps_per_ray, state_depth_, record,
      [&](std::size_t ray, const LogicalVolume* volume, int zero_steps) {
        segments.resize(segments.size() - static_cast<std::size_t>(zero_steps));
        record(ray, volume, -1.0);
      });
  return segments;
}

VecGeomPeer::Totals VecGeomPeer::transport(std::span<const Ray> rays,
                                           std::uint64_t max_steps_per_ray) const {
  const auto nothing = [](auto&&...) {};
  return run(rays, max_steps_per_ray, state_depth_, nothing, nothing);
}

std::vector<LegEnd> VecGeomPeer::follow(const double (&start)[3], std::span<const Leg> legs) const {
  const OwnedState first(state_depth_);
  const OwnedState second(state_depth_);
  const vecgeom::VPlacedVolume* world = vecgeom::GeoManager::Instance().GetWorld();
  NavigationState* in = first.get();
  NavigationState* out = second.get();
  Vector position = to_vector(start);
  in->Clear();
  vecgeom::GlobalLocator::LocateGlobalPoint(world, position, *in, true);
  forget_last_exited(*in, world);
  std::vector<LegEnd> ends;
  std::uint64_t boundaries = 0;
  for (const Leg& leg : legs) {
    const Vector direction = to_vector(leg.direction);
    double left = leg.length;
    for (int zero_steps = 0; left > 0;) {
      if (in->IsOutside() || zero_steps >= zero_steps_allowed) return ends;
      const double step =
          in->Top()->GetLogicalVolume()->GetNavigator()->ComputeStepAndPropagatedState(
              position, direction, left, *in, *out);
      zero_steps = step <= vecgeom::kTolerance ? zero_steps + 1 : 0;
      boundaries += out->IsOnBoundary() ? 1 : 0;
      position += step * direction;
      left -= step;
      forget_last_exited(*out, world);
      std::swap(in, out);
    }
    ends.push_back({{position.x(), position.y(), position.z()}, boundaries});
  }
  return ends;
}

VecGeomPeer::Totals VecGeomPeer::fly(std::span<const Flight> flights, bool safety,
                                     double& safeties) const {
  struct Place {
    OwnedState state;
    Vector position{};
    bool on_boundary = false;
    explicit Place(int depth) : state(depth) {}
  };
  Totals totals;
  const vecgeom::VPlacedVolume* world = vecgeom::GeoManager::Instance().GetWorld();
  const OwnedState first(state_depth_);
  const OwnedState second(state_depth_);
  NavigationState* in = first.get();
  NavigationState* next = second.get();
  Vector position{};
  bool on_boundary = false;
  std::vector<std::unique_ptr<Place>> waiting;
  std::size_t waits = 0;  // places are reused, since a new state is an allocation
  for (const Flight& flight : flights) {
    position = to_vector(flight.start);
    in->Clear();
    vecgeom::GlobalLocator::LocateGlobalPoint(world, position, *in, true);
    waits = 0;
    on_boundary = false;
    for (const FlightStep& planned : flight.steps) {
      if (!in->IsOutside()) {
        if (safety && !on_boundary) {
          safeties +=
              in->Top()->GetLogicalVolume()->GetSafetyEstimator()->ComputeSafety(position, *in);
        }
        const Vector direction = to_vector(planned.direction);
        for (int zero_steps = 0; zero_steps < zero_steps_allowed && !in->IsOutside();
             ++zero_steps) {
          forget_last_exited(*in, world);
          const double step =
              in->Top()->GetLogicalVolume()->GetNavigator()->ComputeStepAndPropagatedState(
                  position, direction, planned.limit, *in, *next);
          position += step * direction;
          totals.length += step;
          on_boundary = next->IsOnBoundary();
          std::swap(in, next);
          if (!on_boundary || step > no_length) break;
          ++totals.zero_steps;
        }
        ++totals.steps;
      }
      if (planned.secondary) {
        if (waits == waiting.size()) waiting.push_back(std::make_unique<Place>(state_depth_));
        Place& place = *waiting[waits++];
        in->CopyTo(place.state.get());
        place.position = position;
        place.on_boundary = on_boundary;
      }
      if (planned.stops && waits > 0) {
        const Place& place = *waiting[--waits];
        place.state.get()->CopyTo(in);
        position = place.position;
        on_boundary = place.on_boundary;
      }
    }
  }
  return totals;
}

VecGeomPeer::States VecGeomPeer::prepare_states(std::span<const Ray> rays) const {
  auto impl = std::make_unique<States::Impl>(static_cast<int>(rays.size()), state_depth_);
  impl->volumes.reserve(rays.size());
  const vecgeom::VPlacedVolume* world = vecgeom::GeoManager::Instance().GetWorld();
  bool same = true;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    NavigationState& state = *impl->pool[static_cast<int>(i)];
    vecgeom::GlobalLocator::LocateGlobalPoint(world, to_vector(rays[i].position), state, true);
    forget_last_exited(state, world);
    const LogicalVolume* volume = state.IsOutside() ? nullptr : state.Top()->GetLogicalVolume();
    if (volume == nullptr) {
      impl->volumes.push_back(no_volume);
      ++impl->outside;
      continue;
    }
    impl->volumes.push_back(index_of_id_[volume->id()]);
    if (impl->common == nullptr) impl->common = volume;
    same = same && impl->common == volume;
  }
  if (!same) impl->common = nullptr;
  return States(std::move(impl));
}

VecGeomPeer::Totals VecGeomPeer::one_step(const States& states, std::span<const Ray> rays) const {
  const States::Impl& in = *states.impl_;
  const std::size_t n = std::min(rays.size(), states.size());
  const OwnedState out(state_depth_);
  const vecgeom::VNavigator* common = in.common != nullptr ? in.common->GetNavigator() : nullptr;
  Totals totals;
  for (std::size_t i = 0; i < n; ++i) {
    const NavigationState& state = *in.pool[static_cast<int>(i)];
    if (state.IsOutside()) continue;
    const vecgeom::VNavigator* navigator =
        common != nullptr ? common : state.Top()->GetLogicalVolume()->GetNavigator();
    const double step = navigator->ComputeStepAndPropagatedState(
        to_vector(rays[i].position), to_vector(rays[i].direction), vecgeom::kInfLength, state,
        *out.get());
    totals.length += step;
    totals.zero_steps += step <= vecgeom::kTolerance ? 1 : 0;
    ++totals.steps;
  }
  return totals;
}

double VecGeomPeer::safety(const States& states, std::span<const Ray> rays) const {
  const States::Impl& in = *states.impl_;
  const std::size_t n = std::min(rays.size(), states.size());
  const vecgeom::VSafetyEstimator* common =
      in.common != nullptr ? in.common->GetSafetyEstimator() : nullptr;
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const NavigationState& state = *in.pool[static_cast<int>(i)];
    if (state.IsOutside()) continue;
    const vecgeom::VSafetyEstimator* estimator =
        common != nullptr ? common : state.Top()->GetLogicalVolume()->GetSafetyEstimator();
    total += estimator->ComputeSafety(to_vector(rays[i].position), state);
  }
  return total;
}

}  // namespace navjit::peers
