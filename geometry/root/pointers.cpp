#include "geometry/root/pointers.hpp"

namespace navjit::root {
namespace {

constexpr std::uint32_t new_class = 0xffffffff, class_mask = 0x80000000;
constexpr std::size_t offset_of_places = 2;

}  // namespace

Reference RecordBytes::pointer(Bytes& at) const {
  const std::size_t begin = at.at();
  const std::uint32_t first = at.u32();
  if ((first & byte_count_mask) == 0 || first == new_class) {
    if ((first & class_mask) != 0) throw FormatError("an object has no length");
    return first;
  }
  at.skip(first & ~byte_count_mask);
  return static_cast<Reference>(begin + key_bytes + offset_of_places);
}

Located RecordBytes::locate(Reference reference) const {
  const std::size_t before = key_bytes + offset_of_places;
  if (reference < before) throw FormatError("a pointer leads out of the geometry");
  Bytes at(bytes, reference - before);
  const std::uint32_t length = at.u32();
  if ((length & byte_count_mask) == 0 || (length & ~byte_count_mask) > at.left()) {
    throw FormatError("a pointer leads to no object");
  }
  Located found;
  found.end = at.at() + (length & ~byte_count_mask);
  const std::uint32_t tag = at.u32();
  if (tag == new_class) {
    found.type = at.zero_ended();
  } else {
    const std::uint32_t named = tag & ~class_mask;
    if ((tag & class_mask) == 0 || named < before) throw FormatError("an object has no class");
    Bytes name(bytes, named - before);
    if (name.u32() != new_class) throw FormatError("an object has no class");
    found.type = name.zero_ended();
  }
  found.begin = at.at();
  constexpr std::size_t longest_name = 1000;
  if (found.begin > found.end || found.type.size() > longest_name) {
    throw FormatError("an object has no class");
  }
  return found;
}

}  // namespace navjit::root
