#include "geometry/root/lists.hpp"

namespace navjit::root {

std::vector<Reference> list_at(const RecordBytes& record, std::string_view type, Bytes at,
                               const std::function<void(std::size_t)>& spend) {
  const bool array = type == "TObjArray", list = type == "TList" || type == "THashList";
  if (!array && !list) return {};
  const VersionHeader header = version_header(at);
  // Lists of earlier versions were written in another way.
  if (list && header.version < 4) return {};
  if (list || header.version > 2) object_bits(at);
  if (list || header.version > 1) at.text();  // name
  const std::uint32_t count = at.u32();
  if (array) at.skip(4);  // the first number
  // A pointer takes at least four bytes.
  if (count > at.left() / 4) throw FormatError("a list has fewer objects than it says");
  spend(count);
  std::vector<Reference> objects;
  objects.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    objects.push_back(record.pointer(at));
    if (list) at.text();  // option
  }
  return objects;
}

}  // namespace navjit::root
