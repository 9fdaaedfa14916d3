// Reads numbers of all types that members have.
#pragma once

#include <cstdint>
#include <iterator>

#include "geometry/root/bytes.hpp"

namespace navjit::root {

/// The bytes of a number of a type from 1 to 19; 0 for types without a fixed size.
inline std::size_t number_size(std::uint32_t type) {
  constexpr std::size_t sizes[] = {0, 1, 2, 4, 8, 4, 4, 0, 8, 4, 1, 1, 2, 4, 8, 4, 8, 8, 1, 0};
  return type < std::size(sizes) ? sizes[type] : 0;
}

inline double number_at(Bytes& at, std::uint32_t type) {
  switch (type) {
    case 1:
    case 10:
      return static_cast<std::int8_t>(at.u8());
    case 2:
      return static_cast<std::int16_t>(at.u16());
    case 3:
    case 6:
      return static_cast<std::int32_t>(at.u32());
    case 4:
    case 16:
      return static_cast<double>(static_cast<std::int64_t>(at.u64()));
    case 5:
    case 9:
      return at.f32();
    case 8:
      return at.f64();
    case 11:
    case 18:
      return at.u8();
    case 12:
      return at.u16();
    case 13:
    case 15:
      return at.u32();
    default:
      return static_cast<double>(at.u64());
  }
}

}  // namespace navjit::root
