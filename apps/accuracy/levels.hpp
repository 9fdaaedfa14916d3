// The engines of our own, which are called levels here: exact, and the generic navigator that it is
// compared with.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "apps/accuracy/made.hpp"
#include "geometry/model/world.hpp"
#include "navjit/runtime.hpp"
#include "navjit/search.hpp"

namespace navjit::accuracy {

/// A way to navigate. The first is the generic navigator.
struct NavigatorLevel {
  const char* name;
  JitMode jit;
};
/// All there are: a level that is added to navjit becomes a row of the tables by an entry here.
std::span<const NavigatorLevel> navigator_levels();

/// An engine at one level, ready: with `exact`, every scene is specialised that is worth it.
class LevelEngine {
 public:
  LevelEngine(std::shared_ptr<const World> world, const NavigatorLevel& level,
              const GeometryOptions& options);

  const NavigatorLevel& level() const { return level_; }
  Runtime& runtime() { return *runtime_; }

 private:
  NavigatorLevel level_;
  std::unique_ptr<Runtime> runtime_;
};

/// Every step of a ray.
MadeRay make_ray_steps(Navigator& navigator, const World& world, const Ray& ray, std::size_t index);
/// Whether two engines did the same to the last bit.
bool identical(const MadeRay& a, const MadeRay& b);
/// How many of the steps of `b` are, one by one, those of `a` to the last bit.
std::size_t equal_steps(const MadeRay& a, const MadeRay& b);

}  // namespace navjit::accuracy
