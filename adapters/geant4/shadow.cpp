#include "navjit/geant4/shadow.hpp"

#include <G4TouchableHistory.hh>
#include <G4VSolid.hh>
#include <G4ios.hh>
#include <algorithm>
#include <cmath>
#include <sstream>

namespace navjit::geant4 {
namespace {

constexpr double most_length = 1e-6;  // mm
constexpr double most_normal = 1e-3;

std::string text(const G4NavigationHistory& history) {
  std::ostringstream text;
  for (std::size_t i = 0; i <= history.GetDepth(); ++i) {
    const auto level = static_cast<G4int>(i);
    const G4VPhysicalVolume* volume = history.GetVolume(level);
    text << (i == 0 ? "" : "/") << (volume == nullptr ? "none" : volume->GetName());
    if (i > 0) text << ':' << history.GetReplicaNo(level);
  }
  return std::move(text).str();
}

bool equal(const G4NavigationHistory& a, const G4NavigationHistory& b) {
  if (a.GetDepth() != b.GetDepth()) return false;
  for (std::size_t i = 1; i <= a.GetDepth(); ++i) {
    const auto level = static_cast<G4int>(i);
    if (a.GetVolume(level) != b.GetVolume(level) ||
        a.GetReplicaNo(level) != b.GetReplicaNo(level)) {
      return false;
    }
  }
  return true;
}

/// Whether frames are the same to callers, which cannot see which way they are stored.
bool same_frame(const G4AffineTransform& a, const G4AffineTransform& b) {
  for (G4int i = 0; i < 16; ++i) {
    if (std::abs(a[i] - b[i]) > 1e-9 * (1 + std::abs(a[i]))) return false;
  }
  return true;
}

template <typename... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.precision(17);
  (text << ... << parts);
  return std::move(text).str();
}

}  // namespace

ShadowNavigator::ShadowNavigator(std::shared_ptr<Session> session)
    : Navigator(std::move(session)), to_print_(this->session().options().printed_differences) {
  geant4_.SetPushVerbosity(false);
}

void ShadowNavigator::print(const char* call, const G4ThreeVector& point, const std::string& what) {
  if (to_print_ <= 0) return;
  --to_print_;
  G4cout << "navjit shadow: " << call << " at " << sentence(point) << " in " << text(fHistory)
         << ": " << what << G4endl;
}

G4double ShadowNavigator::step(const G4ThreeVector& point, const G4ThreeVector& direction,
                               G4double limit, G4double& safety) {
  const double ours = Navigator::step(point, direction, limit, safety);
  if (!active()) return ours;
  double their_safety = 0;
  const double theirs = geant4_.ComputeStep(point, direction, limit, their_safety);
  if (!state().inside()) return ours;
  Differences& differences = counts().differences;
  ++differences.steps;
  const double a = std::min(ours, limit), b = std::min(theirs, limit);
  const double difference = a == b ? 0 : std::abs(a - b);
  // In huge worlds no number is so accurate.
  const double rounding = 1e-14 * (point.mag() + b);
  if (difference > std::max(most_length, rounding)) {
    ++differences.lengths;
    print("ComputeStep", point,
          sentence("navjit ", ours, ", Geant4 ", theirs, " mm, along ", direction, ", limit ",
                   limit));
  } else {
    differences.largest_length = std::max<double>(differences.largest_length, difference);
  }
  if (theirs <= limit && safety > theirs + most_length) {
    ++differences.safeties;
    print("ComputeStep", point, sentence("navjit's safety ", safety, ", Geant4's step ", b));
  }
  return ours;
}

void ShadowNavigator::Geant4::set(const G4NavigationHistory& history, const G4ThreeVector& point) {
  ResetState();
  fHistory = history;
  SetupHierarchy();
  LocateGlobalPointWithinVolume(point);
}

void ShadowNavigator::compare_histories(const char* call, const G4ThreeVector& point,
                                        const Circumstances& circumstances, G4VPhysicalVolume* ours,
                                        G4VPhysicalVolume* theirs) {
  Differences& differences = counts().differences;
  ++differences.locates;
  const bool agree =
      ours == theirs && (ours == nullptr || (equal(fHistory, geant4_.history()) &&
                                             same_frame(fHistory.GetTopTransform(),
                                                        geant4_.history().GetTopTransform())));
  if (!agree) {
    // If the point is on a face, either side is right; so is a volume that the track is about to
    // leave.
    const bool tie =
        state().inside()
            ? distance_to_boundary({point.x(), point.y(), point.z()}) < most_length
            : GetWorldVolume()->GetLogicalVolume()->GetSolid()->Inside(point) == kSurface;
    ++(tie ? differences.ties : differences.histories);
    if (!tie) {
      print(call, point,
            sentence(
                ours == nullptr ? "navjit is outside; " : "", "Geant4 is ",
                theirs == nullptr ? "outside" : "in " + text(geant4_.history()), "; from ",
                text(circumstances.before), circumstances.by_step ? " by a step" : "", ", along ",
                circumstances.direction == nullptr ? G4ThreeVector() : *circumstances.direction));
    }
    if (ours != nullptr) geant4_.set(fHistory, point);
  }
  // Geant4's navigator may have set up another copy.
  if (ours != nullptr) SetupHierarchy();
}

G4VPhysicalVolume* ShadowNavigator::reset(const G4ThreeVector& point,
                                          const G4ThreeVector& direction,
                                          const G4TouchableHistory& history) {
  G4VPhysicalVolume* ours = Navigator::reset(point, direction, history);
  if (!active()) return ours;
  if (geant4_.GetWorldVolume() != GetWorldVolume()) geant4_.SetWorldVolume(GetWorldVolume());
  compare_histories("ResetHierarchyAndLocate", point, {*history.GetHistory(), &direction, false},
                    ours, geant4_.ResetHierarchyAndLocate(point, direction, history));
  return ours;
}

G4VPhysicalVolume* ShadowNavigator::locate(const G4ThreeVector& point,
                                           const G4ThreeVector* direction, bool relative,
                                           bool ignore_direction) {
  const G4NavigationHistory before(fHistory);
  const bool by_step = fWasLimitedByGeometry;
  if (relative && fWasLimitedByGeometry && active()) {
    const Crossing* made = made_step({point.x(), point.y(), point.z()});
    const auto vector = [](const Vec3& v) { return G4ThreeVector(v.x, v.y, v.z); };
    double safety = 0;
    // Geant4's has to know which of two steps was made; what it found last is forgotten.
    if (made != nullptr && made != boundary()) {
      geant4_.LocateGlobalPointWithinVolume(vector(made->start));
      geant4_.ComputeStep(vector(made->start), vector(made->direction), made->limit, safety);
    }
    geant4_.SetGeometricallyLimitedStep();
  }
  G4VPhysicalVolume* ours = Navigator::locate(point, direction, relative, ignore_direction);
  if (!active()) return ours;
  if (geant4_.GetWorldVolume() != GetWorldVolume()) geant4_.SetWorldVolume(GetWorldVolume());
  compare_histories(
      "LocateGlobalPointAndSetup", point, {before, direction, by_step}, ours,
      geant4_.LocateGlobalPointAndSetup(point, direction, relative, ignore_direction));
  return ours;
}

void ShadowNavigator::relocate_within(const G4ThreeVector& point) {
  Navigator::relocate_within(point);
  if (active()) geant4_.LocateGlobalPointWithinVolume(point);
}

G4double ShadowNavigator::safety_at(const G4ThreeVector& point, G4double enough) {
  const double ours = Navigator::safety_at(point, enough);
  if (active()) geant4_.ComputeSafety(point, enough);
  return ours;
}

G4ThreeVector ShadowNavigator::exit_normal(const Crossing& crossing) {
  const G4ThreeVector ours = Navigator::exit_normal(crossing);
  G4bool valid = false;
  const G4ThreeVector end(crossing.end.x, crossing.end.y, crossing.end.z);
  const G4ThreeVector theirs = geant4_.GetGlobalExitNormal(end, &valid);
  if (valid && (ours - theirs).mag() > most_normal) {
    ++counts().differences.normals;
    print("GetGlobalExitNormal", end, sentence("navjit ", ours, ", Geant4 ", theirs));
  }
  return ours;
}

}  // namespace navjit::geant4
