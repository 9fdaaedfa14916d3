// The memory for the numbers of scenes, which is freed as a whole.
#pragma once

#include <algorithm>
#include <memory_resource>
#include <span>
#include <type_traits>
#include <vector>

namespace navjit::codegen {

/// Hands out arrays and structs that live as long as the arena. None of them has a destructor.
class Arena {
 public:
  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// `count` values that are zero; null for none.
  template <class Value>
  Value* array(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<Value>);
    if (count == 0) return nullptr;
    // Small arrays share cache lines with the arrays made just before.
    const std::size_t bytes = count * sizeof(Value);
    const std::size_t align = std::max<std::size_t>(alignof(Value), bytes >= 64 ? 64 : 1);
    auto* values = static_cast<Value*>(memory_.allocate(bytes, align));
    std::uninitialized_value_construct_n(values, count);
    return values;
  }
  template <class Value>
  const Value* copy(std::span<const Value> from) {
    Value* values = array<Value>(from.size());
    std::copy(from.begin(), from.end(), values);
    return values;
  }
  template <class Value>
  const Value* copy(const std::vector<Value>& from) {
    return copy(std::span<const Value>(from));
  }

 private:
  std::pmr::monotonic_buffer_resource memory_{std::size_t{1} << 16};
};

}  // namespace navjit::codegen
