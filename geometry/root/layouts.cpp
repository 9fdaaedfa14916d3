#include "geometry/root/layouts.hpp"

#include "geometry/root/lists.hpp"

namespace navjit::root {
namespace {

/// Reads a TNamed within an object.
std::string named_at(Bytes& at) {
  const VersionHeader header = version_header(at);
  object_bits(at);
  std::string name(at.text());
  if (header.end == 0) {
    at.text();  // title
  } else {
    at = Bytes(at.all(), header.end);
  }
  return name;
}

/// "TGeoFacet" for "vector<TGeoFacet>"; empty for everything else.
std::string_view content_of(std::string_view type) {
  if (type.starts_with("std::")) type.remove_prefix(5);
  constexpr std::string_view start = "vector<";
  if (!type.starts_with(start) || !type.ends_with(">")) return {};
  return type.substr(start.size(), type.size() - start.size() - 1);
}

/// Reads a TStreamerElement of any class.
Member member_at(const RecordBytes& record, Reference reference) {
  const Located found = record.locate(reference);
  Bytes at(record.bytes.substr(0, found.end), found.begin);
  version_header(at);
  const VersionHeader element = version_header(at);
  Member member;
  member.name = named_at(at);
  member.type = at.u32();
  at.skip(4);  // bytes in memory
  member.length = at.u32();
  at.skip(4);  // dimensions
  const std::uint32_t dimensions = element.version == 1 ? at.u32() : 5;
  if (dimensions > at.left() / 4) throw FormatError("a class has too many dimensions");
  at.skip(std::size_t{4} * dimensions);
  member.content = content_of(at.text());
  if (element.end != 0) at = Bytes(at.all(), element.end);
  if (found.type == "TStreamerBasicPointer" || found.type == "TStreamerLoop") {
    at.skip(4);  // version of the class that has the counter
    member.counter = at.text();
  }
  return member;
}

}  // namespace

Layouts::Layouts(Container& file) {
  const std::optional<Key> key = file.streamer_infos();
  if (!key) return;
  const std::string bytes = file.object(*key);
  const RecordBytes record{bytes, key->key_bytes};
  std::size_t budget = 1'000'000;
  const auto spend = [&](std::size_t count) {
    if (count > budget) throw FormatError("its classes have too many members");
    budget -= count;
  };
  for (const Reference reference : list_at(record, "TList", Bytes(bytes), spend)) {
    if (reference == 0) continue;
    const Located found = record.locate(reference);
    if (found.type != "TStreamerInfo") continue;  // rules for reading older classes
    Bytes at(record.bytes.substr(0, found.end), found.begin);
    version_header(at);
    const std::string name = named_at(at);
    at.skip(4);  // checksum
    const auto version = static_cast<int>(at.u32());
    const Reference members = record.pointer(at);
    if (members == 0) continue;
    const Located list = record.locate(members);
    Layout layout;
    for (const Reference member :
         list_at(record, list.type, Bytes(record.bytes.substr(0, list.end), list.begin), spend)) {
      if (member != 0) layout.push_back(member_at(record, member));
    }
    spend(1);
    layouts_[name].insert_or_assign(version, std::move(layout));
  }
}

const Layout* Layouts::find(std::string_view type, int version) const {
  const auto found = layouts_.find(type);
  if (found == layouts_.end()) return nullptr;
  const auto exact = found->second.find(version);
  return exact != found->second.end() ? &exact->second : &found->second.rbegin()->second;
}

}  // namespace navjit::root
