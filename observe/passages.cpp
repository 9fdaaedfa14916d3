#include "observe/passages.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

#include "geometry/navigation/generic.hpp"
#include "geometry/rays/ray_maker.hpp"
#include "navjit/detail/standing.hpp"

namespace navjit {
namespace {

class Recorder {
 public:
  explicit Recorder(const std::shared_ptr<const World>& world)
      : geometry_(world), tolerance_(world->tolerance) {
    passages_.nodes.push_back({0, world->top, 0});
  }

  void pass(std::uint32_t number, const Ray& ray) {
    Vec3 point = ray.position;
    generic::locate(geometry_, *stack_, point, ray.direction);
    std::vector<std::pair<TouchableId, std::uint32_t>> before;  // touchable and node of each level
    std::map<std::uint32_t, double> lengths;
    for (detail::Standing standing; stack_->depth >= 0 && !standing.stuck();) {
      const std::size_t common = enter(before);
      const std::uint32_t node = before.back().second;
      if (last_) ++boundaries_[{*last_, node, static_cast<std::uint32_t>(common)}];
      last_ = node;
      const double length = generic::step(geometry_, *stack_, point, ray.direction,
                                          std::numeric_limits<double>::infinity());
      standing.count(length, tolerance_);
      lengths[node] += length;
      point += length * ray.direction;
    }
    last_.reset();
    for (const auto& [node, length] : lengths) passages_.lengths.push_back({node, number, length});
    ++passages_.rays;
  }

  Passages finish() {
    std::sort(passages_.lengths.begin(), passages_.lengths.end(),
              [](const PassedLength& a, const PassedLength& b) {
                return std::tie(a.node, a.ray) < std::tie(b.node, b.ray);
              });
    for (const auto& [key, count] : boundaries_) {
      passages_.boundaries.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), count});
    }
    return std::move(passages_);
  }

 private:
  /// Makes `levels` those of the stack. Returns how many levels have the same touchables as before.
  std::size_t enter(std::vector<std::pair<TouchableId, std::uint32_t>>& levels) {
    const auto depth = static_cast<std::size_t>(stack_->depth);
    std::size_t same = 0;
    while (same < levels.size() && same <= depth &&
           levels[same].first == stack_->levels[same].touchable) {
      ++same;
    }
    levels.resize(same);
    for (std::size_t i = same; i <= depth; ++i) {
      const std::uint32_t mother = i == 0 ? 0 : levels[i - 1].second;
      levels.emplace_back(stack_->levels[i].touchable,
                          i == 0 ? 0 : node_of(mother, stack_->levels[i].volume, i));
    }
    return same == 0 ? 0 : same - 1;
  }

  std::uint32_t node_of(std::uint32_t mother, VolumeId volume, std::size_t depth) {
    const std::uint64_t key = std::uint64_t{mother} << 32 | volume;
    const auto next = static_cast<std::uint32_t>(passages_.nodes.size());
    const auto [entry, fresh] = numbers_.try_emplace(key, next);
    if (fresh) passages_.nodes.push_back({mother, volume, static_cast<std::uint32_t>(depth)});
    return entry->second;
  }

  Geometry geometry_;
  double tolerance_;
  std::unique_ptr<NavigationStack> stack_ = std::make_unique<NavigationStack>();
  std::optional<std::uint32_t> last_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint64_t> boundaries_;
  Passages passages_;
};

}  // namespace

std::vector<Ray> sample(const World& world, const Observation::Rays& rays, std::uint64_t count,
                        std::uint64_t seed) {
  RaySource source{.origin = rays.origin, .eta = rays.eta, .seed = seed};
  if (!rays.origin) source.aim = "auto";
  const RayMaker maker(world, source);
  std::vector<Ray> made;
  for (std::uint64_t i = 0; i < count; ++i) made.push_back(maker.ray(i));
  return made;
}

Passages pass_through(const std::shared_ptr<const World>& world, std::span<const Ray> rays) {
  Recorder recorder(world);
  std::uint32_t number = 0;
  for (const Ray& ray : rays) recorder.pass(number++, ray);
  return recorder.finish();
}

}  // namespace navjit
