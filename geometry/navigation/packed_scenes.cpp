#include "geometry/navigation/packed_scenes.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

#include "geometry/model/daughter_holding.hpp"
#include "geometry/navigation/geometry.hpp"

namespace navjit {
namespace {

/// Keeps one copy of equal bytes. A value that fits into a cache line is in one line only.
class SharedBytes {
 public:
  explicit SharedBytes(std::pmr::memory_resource& memory) : memory_(memory) {}

  /// `label` distinguishes values of different meaning that happen to have the same bytes.
  template <class Value>
  const Value* keep(int label, const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value> && alignof(Value) <= step);
    const std::string_view bytes(reinterpret_cast<const char*>(&value), sizeof(Value));
    const auto known = known_.find({label, bytes});
    if (known != known_.end()) return static_cast<const Value*>(known->second);
    void* const place = room(sizeof(Value));
    std::memcpy(place, &value, sizeof(Value));
    known_.emplace(std::pair(label, std::string_view(static_cast<char*>(place), sizeof(Value))),
                   place);
    return static_cast<const Value*>(place);
  }

 private:
  static constexpr std::size_t step = 8;

  void* room(std::size_t bytes) {
    bytes = (bytes + step - 1) / step * step;
    if (bytes > cache_line) return memory_.allocate(bytes, cache_line);
    if (bytes > left_) {
      line_ = static_cast<char*>(memory_.allocate(cache_line, cache_line));
      left_ = cache_line;
    }
    return line_ + (cache_line - std::exchange(left_, left_ - bytes));
  }

  std::pmr::memory_resource& memory_;
  std::map<std::pair<int, std::string_view>, const void*> known_;
  char* line_ = nullptr;
  std::size_t left_ = 0;  ///< bytes left in the cache line
};

}  // namespace

PackedScenes::PackedScenes(std::span<const Scene> scenes)
    : memory_(std::make_unique<std::pmr::monotonic_buffer_resource>(std::size_t{1} << 16)) {
  SharedBytes shared(*memory_);
  constexpr int rotation_label = -1;
  const auto keep_solid = [&](const kernels::AnySolid<double>& solid) {
    return visit(solid, [&](const auto& shape) {
      return kernels::AnySolid<double>{solid.kind,
                                       shared.keep(static_cast<int>(solid.kind), shape)};
    });
  };
  std::size_t total = 0;
  for (const Scene& scene : scenes) total += scene.daughters.size();
  daughters_.reserve(total);  // pointers to its elements are taken below
  scenes_.reserve(scenes.size());
  per_touchable_.reserve(scenes.size());
  for (const Scene& scene : scenes) {
    const PackedDaughter* const first = daughters_.data() + daughters_.size();
    for (const Daughter& d : scene.daughters) {
      const double(&t)[3] = d.transformation.translation;
      const double* rotation = nullptr;
      if (d.transformation.rotated) {
        std::array<double, 9> numbers;
        std::copy_n(d.transformation.rotation, 9, numbers.begin());
        rotation = shared.keep(rotation_label, numbers)->data();
      }
      daughters_.push_back({{t[0], t[1], t[2]}, rotation, keep_solid(d.solid), d.offset, d.volume});
    }
    const NeighbourLists& lists = scene.neighbour_lists;
    scenes_.push_back({keep_solid(scene.solid), first, scene.boxes.get(),
                       lists.of.empty() ? nullptr : lists.of.data(), lists.neighbours.data(),
                       lists.blocks.data(), static_cast<std::uint32_t>(scene.daughters.size()),
                       scene.search});
    per_touchable_.push_back(navjit::daughters_per_touchable(scene.daughters));
  }
}

}  // namespace navjit
