// Makes rays one by one, or many at once.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "navjit/observation.hpp"
#include "navjit/runtime.hpp"
#include "runtime/transport_basket.hpp"

namespace navjit::apps {

/// For one thread. The detector's boundaries that are not seen are no end of a step.
class RayMaker {
 public:
  /// `basket`: how many at once; 0: one by one.
  RayMaker(Runtime& runtime, const ObservedDetector& seen, std::size_t basket) : seen_(&seen) {
    if (basket > 0) {
      basket_.emplace(runtime.basket(basket));
    } else {
      navigator_.emplace(runtime.navigator());
    }
  }

  /// Totals of the rays in their order, as long as `go_on()` says so.
  template <class GoOn>
  std::vector<RayTotals> make(std::span<const Ray> rays, double tolerance, GoOn&& go_on) {
    if (basket_) {
      return transport_in_basket(
          *basket_, rays, tolerance, [](std::size_t, const State&, double) {}, go_on,
          [this](const State& from, const State& to) {
            return seen_->counts(from.volume(), to.volume());
          });
    }
    ObservedNavigator navigator(*seen_, *navigator_);
    std::vector<RayTotals> made;
    made.reserve(rays.size());
    for (const Ray& ray : rays) {
      if (!go_on()) break;
      made.push_back(transport(navigator, ray, tolerance));
    }
    return made;
  }

  const NavigatorCounts& counts() const {
    return basket_ ? basket_->counts() : navigator_->counts();
  }

 private:
  const ObservedDetector* seen_;
  std::optional<Navigator> navigator_;
  std::optional<Basket> basket_;
};

}  // namespace navjit::apps
