// Reads members that are a std::vector of objects which are made of numbers alone.
#include <algorithm>
#include <optional>

#include "geometry/root/numbers.hpp"
#include "geometry/root/objects.hpp"

namespace navjit::root {
namespace {

/// The members of objects in vectors that are kept, written with the name of the vector.
constexpr std::string_view kept[] = {"fFacets.fIvert", "fFacets.fNvert", "fVertices.fVec"};

/// One member of all objects: so many numbers of a type in each object.
struct Column {
  std::uint32_t type = 0;
  std::size_t width = 1;
  std::optional<std::string_view> name{};  ///< the name under which they are kept
  std::vector<double> numbers{};

  std::size_t bytes() const { return width * number_size(type); }
  void read(Bytes& at) {
    if (!name) return at.skip(bytes());
    for (std::size_t i = 0; i < width; ++i) numbers.push_back(number_at(at, type));
  }
};

/// The columns; none if a member is anything else than numbers.
std::vector<Column> columns_of(const Layout& layout, const std::string& vector) {
  std::vector<Column> columns;
  for (const Member& member : layout) {
    const bool array = member.type > basic_end && member.type < counted;
    Column column{.type = array ? member.type - basic_end : member.type};
    if (array) column.width = member.length;
    if (number_size(column.type) == 0) return {};
    const auto* const found = std::ranges::find(kept, vector + '.' + member.name);
    if (found != std::end(kept)) column.name = *found;
    columns.push_back(std::move(column));
  }
  return columns;
}

/// A class without versions has version 0, and after it a checksum.
std::uint16_t skip_checksum(Bytes& at, std::uint16_t version) {
  if (version == 0) at.skip(4);
  return version;
}

}  // namespace

bool Objects::read_vector(Bytes& at, const Member& member, Object& into) {
  const VersionHeader header = version_header(at);
  if (header.end == 0) return false;
  Bytes in(at.all().substr(0, header.end), at.at());
  at = Bytes(at.all(), header.end);
  // The members follow member by member for all objects, or else object by object.
  constexpr std::uint16_t by_members = 1U << 14;
  const bool by_member = (header.version & by_members) != 0;
  std::uint16_t version = by_member ? skip_checksum(in, in.u16()) : 0;
  const std::size_t count = in.u32();
  if (count == 0) return true;
  if (!by_member) {
    Bytes ahead = in;
    version = version_header(ahead).version;
  }
  const Layout* layout = layouts_.find(member.content, version);
  if (layout == nullptr) return true;
  std::vector<Column> columns = columns_of(*layout, member.name);
  std::size_t bytes = 0;
  for (const Column& column : columns) bytes += column.bytes();
  if (bytes == 0) return true;
  if (count > in.left() / bytes) into.fail(member.name + " has fewer objects than it says");
  spend(count * bytes);
  if (by_member) {
    for (Column& column : columns) {
      for (std::size_t i = 0; i < count; ++i) column.read(in);
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      const VersionHeader object = version_header(in);
      skip_checksum(in, object.version);
      for (Column& column : columns) column.read(in);
      if (object.end != 0) in = Bytes(in.all(), object.end);
    }
  }
  for (Column& column : columns) {
    if (column.name) into.members.emplace_back(*column.name, std::move(column.numbers));
  }
  return true;
}

}  // namespace navjit::root
