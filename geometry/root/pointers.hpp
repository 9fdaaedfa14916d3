// Pointers between the objects of one record. Where a pointer to an object is written first, the
// object follows in full; later pointers name its place. So any object can be read by itself,
// without those before it.
#pragma once

#include <cstdint>
#include <string_view>

#include "geometry/root/bytes.hpp"

namespace navjit::root {

/// Names an object of a record by its place, as the file does. 0: none. 1: the record's own.
using Reference = std::uint32_t;
constexpr Reference own_object = 1;

/// Where an object is.
struct Located {
  std::string_view type;           ///< its class
  std::size_t begin = 0, end = 0;  ///< the bytes that the class wrote, in the record
};

/// The bytes of a record's object. Places in a file count from the key that precedes it.
struct RecordBytes {
  std::string_view bytes;
  std::size_t key_bytes = 0;

  /// Reads a pointer, and skips the object that stands there in full.
  Reference pointer(Bytes& at) const;
  /// The object of a pointer that is neither 0 nor own_object.
  Located locate(Reference reference) const;
};

}  // namespace navjit::root
