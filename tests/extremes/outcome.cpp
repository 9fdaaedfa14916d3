#include "tests/extremes/outcome.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "apps/accuracy/levels.hpp"
#include "apps/accuracy/peer.hpp"
#include "geometry/gdml/read_world.hpp"

namespace navjit::extremes {
namespace {

namespace fs = std::filesystem;
using accuracy::MadeRay;

/// A detector's file, which exists as long as this object does.
class GdmlFile {
 public:
  explicit GdmlFile(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "navjit_extreme_XXXXXX").string();
    const int handle = mkstemp(name.data());
    if (handle < 0) throw std::runtime_error(name + ": cannot be written");
    close(handle);
    path_ = name + ".gdml";
    fs::rename(name, path_);
    std::ofstream(path_) << text;
  }
  GdmlFile(const GdmlFile&) = delete;
  GdmlFile& operator=(const GdmlFile&) = delete;
  ~GdmlFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A ray's steps; nothing if the navigator refuses the ray.
std::optional<MadeRay> try_ray(Navigator& navigator, const World& world, const Ray& ray,
                               std::size_t index) {
  try {
    return accuracy::make_ray_steps(navigator, world, ray, index);
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

/// Where the second engine's ray differs from that of the first, in words.
std::string difference(const Ray& ray, std::size_t index, const MadeRay& a, const MadeRay& b) {
  std::size_t i = 0;
  const auto row = [&](const MadeRay& made) {
    if (i >= made.steps.size()) return std::string(made.stuck ? "stuck" : "has left the world");
    char text[80];
    std::snprintf(text, sizeof text, "%a mm in ", made.steps[i].length);
    return text + made.steps[i].volume;
  };
  while (i < std::min(a.steps.size(), b.steps.size()) && row(a) == row(b) &&
         a.steps[i].touchable == b.steps[i].touchable) {
    ++i;
  }
  char text[400];
  const Vec3 &p = ray.position, &v = ray.direction;
  std::snprintf(text, sizeof text,
                "ray %zu from (%a, %a, %a) along (%a, %a, %a), step %zu: ", index, p.x, p.y, p.z,
                v.x, v.y, v.z, i);
  return text + row(b) + " instead of " + row(a);
}

}  // namespace

Outcomes run_case(const Case& extreme) {
  const GdmlFile file(extreme.gdml);
  const auto world = std::make_shared<const World>(read_world(file.path()));
  const reference::WideGeometry reference(world);
  const std::vector<Ray> rays = extreme.rays(*world);
  Runtime off(world, {.jit = JitMode::off});
  // Also where it does not pay: what is to be seen is what it answers.
  RuntimeOptions options;
  options.jit = JitMode::wait;
  options.specialiser.keep_only_faster = false;
  Runtime wait(world, options);
  Navigator generic = off.navigator(), specialised = wait.navigator();
  const accuracy::Tolerances tolerances = accuracy::own_tolerances(*world);
  const std::vector<ErrorBound> bounds = error_bounds(*world);
  Outcomes outcomes;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::optional<MadeRay> first = try_ray(generic, *world, rays[i], i);
    const std::optional<MadeRay> second = try_ray(specialised, *world, rays[i], i);
    accuracy::JudgedRay judged;
    if (first) {
      judged = accuracy::judge_ray(reference, rays[i], *first, tolerances);
      outcomes.generic.figures.add(*world, rays[i], *first, judged);
      outcomes.generic.figures.hold_against(bounds, judged);
    } else {
      ++outcomes.generic.refused;
    }
    if (!second) {
      ++outcomes.specialised.refused;
      outcomes.specialised.differing += first ? 1 : 0;
      continue;
    }
    const bool same = first && accuracy::identical(*first, *second);
    if (!same) {
      judged = accuracy::judge_ray(reference, rays[i], *second, tolerances);
      const std::size_t equal = first ? accuracy::equal_steps(*first, *second) : 0;
      const std::size_t most = std::max(first ? first->steps.size() : 0, second->steps.size());
      outcomes.specialised.differing += std::max<std::size_t>(1, most - equal);
      if (first && outcomes.specialised.differences.size() < 5) {
        outcomes.specialised.differences.push_back(difference(rays[i], i, *first, *second));
      }
    }
    outcomes.specialised.figures.add(*world, rays[i], *second, judged);
  }
  for (const SceneReport& scene : wait.report().scenes) {
    outcomes.specialised_scenes += scene.status == SceneStatus::specialised ? 1 : 0;
  }
  return outcomes;
}

Outcome run_vecgeom(const Case& extreme, const std::string& program, double seconds) {
  const GdmlFile file(extreme.gdml_for_vecgeom.empty() ? extreme.gdml : extreme.gdml_for_vecgeom);
  const auto world = std::make_shared<const World>(read_world(file.path()));
  const reference::WideGeometry reference(world);
  const std::vector<Ray> rays = extreme.rays(*world);
  const accuracy::VecGeom vecgeom({program, file.path(), "automatic", seconds});
  Outcome outcome;
  std::vector<MadeRay> made;
  outcome.failure = vecgeom.trace(rays, [&](MadeRay& ray) { made.push_back(std::move(ray)); });
  if (!outcome.failure.empty()) return outcome;
  const accuracy::Tolerances tolerances = accuracy::vecgeom_tolerances(*world);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const accuracy::JudgedRay judged =
        extreme.refused ? accuracy::JudgedRay{}
                        : accuracy::judge_named_ray(reference, rays[i], made[i], tolerances);
    outcome.figures.add(*world, rays[i], made[i], judged);
  }
  return outcome;
}

}  // namespace navjit::extremes
