#include "geometry/root/container.hpp"

#include <algorithm>
#include <map>
#include <system_error>

#include "geometry/input_file.hpp"
#include "geometry/root/unpack.hpp"

namespace navjit {
namespace root {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "root";
constexpr int deepest_folder = 32;

/// A place in a file of more than 2 GB takes eight bytes; the version shows it.
std::uint64_t place(Bytes& bytes, bool large) { return large ? bytes.u64() : bytes.u32(); }

Key parse_key(Bytes& bytes) {
  Key key;
  key.bytes = bytes.u32();
  const bool large = bytes.u16() > 1000;
  key.object_bytes = bytes.u32();
  bytes.skip(4);  // date
  key.key_bytes = bytes.u16();
  key.cycle = bytes.u16();
  key.seek = place(bytes, large);
  place(bytes, large);  // the folder
  key.type = bytes.text();
  key.name = bytes.text();
  bytes.text();  // title
  return key;
}

void open_regular(const fs::path& path, std::ifstream& stream, std::uint64_t& size) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    const bool missing = !error || error == std::errc::no_such_file_or_directory;
    throw FormatError("cannot be read: " + (missing ? "no such file" : error.message()));
  }
  if (!fs::is_regular_file(status)) throw FormatError("cannot be read: it is not a regular file");
  size = fs::file_size(path, error);
  stream.open(path, std::ios::binary);
  if (error || !stream) {
    throw FormatError("cannot be read: it cannot be opened; check its permissions");
  }
}

}  // namespace

Container::Container(const fs::path& path, const RootLimits& limits) : limits_(limits) {
  open_regular(path, stream_, size_);
  const std::string head = read(0, std::min<std::uint64_t>(size_, 100));
  Bytes bytes(head);
  if (const char* why = why_not_fetched(head))
    throw FormatError(std::string("cannot be read: ") + why);
  if (!head.starts_with(magic)) throw FormatError("it is no ROOT file");
  bytes.skip(magic.size());
  const bool large = bytes.u32() >= 1'000'000;
  const std::uint32_t begin = bytes.u32();
  place(bytes, large);  // end
  place(bytes, large);  // free segments
  bytes.skip(8);        // their bytes and number
  const std::uint32_t name_bytes = bytes.u32();
  bytes.skip(1 + 4);  // bytes of a place, and the compression
  infos_ = place(bytes, large);
  read_folder(begin, name_bytes, 0);
  // Of several cycles of a name it takes the newest, at the place of the first.
  std::map<std::pair<std::string, std::string>, std::size_t> first;
  std::vector<Key> newest;
  for (Key& key : keys_) {
    const auto [found, added] = first.try_emplace({key.type, key.name}, newest.size());
    if (added) {
      newest.push_back(std::move(key));
    } else if (newest[found->second].cycle < key.cycle) {
      newest[found->second] = std::move(key);
    }
  }
  keys_ = std::move(newest);
}

std::string Container::read(std::uint64_t at, std::size_t count) {
  if (at > size_ || count > size_ - at) throw FormatError("it ends too early; copy it again");
  std::string bytes(count, '\0');
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(at));
  stream_.read(bytes.data(), static_cast<std::streamsize>(count));
  if (static_cast<std::size_t>(stream_.gcount()) != count) {
    throw FormatError("cannot be read: it ends too early");
  }
  return bytes;
}

Key Container::key_at(std::uint64_t at) {
  // No valid key has names longer than this allows.
  constexpr std::uint64_t most = 70'000;
  if (at >= size_) throw FormatError("it ends too early; copy it again");
  const std::string bytes = read(at, std::min(most, size_ - at));
  Bytes in(bytes);
  Key key = parse_key(in);
  key.seek = at;
  return key;
}

void Container::read_folder(std::uint64_t seek, std::size_t before, int depth) {
  if (depth > deepest_folder) throw FormatError("its folders are nested too deep");
  if (before > size_) throw FormatError("it ends too early; copy it again");
  const std::uint64_t at = seek + before;
  constexpr std::size_t longest = 2 + 8 + 8 + 24;
  if (at >= size_) throw FormatError("it ends too early; copy it again");
  const std::string record = read(at, std::min<std::uint64_t>(longest, size_ - at));
  Bytes bytes(record);
  const bool large = bytes.u16() > 1000;
  bytes.skip(8);  // dates
  const std::uint32_t keys_bytes = bytes.u32();
  bytes.skip(4);  // bytes of the name
  place(bytes, large);
  place(bytes, large);
  const std::uint64_t keys_at = place(bytes, large);
  if (keys_at == 0 || keys_bytes == 0) return;  // an empty folder, or a file that was not closed
  // Without this, a folder that contains itself would be read again and again.
  list_bytes_ += keys_bytes;
  if (list_bytes_ > size_) throw FormatError("its folders have more in them than the file is long");
  const std::string list = read(keys_at, keys_bytes);
  Bytes in(list);
  parse_key(in);
  const std::uint32_t count = in.u32();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (++records_ > limits_.max_keys) {
      throw FormatError("more than " + std::to_string(limits_.max_keys) +
                        " objects; raise RootLimits::max_keys if this is meant");
    }
    Key key = parse_key(in);
    if (key.type == "TDirectory" || key.type == "TDirectoryFile") {
      read_folder(key.seek, key.key_bytes, depth + 1);
    } else {
      keys_.push_back(std::move(key));
    }
  }
}

std::string Container::object(const Key& key) {
  if (key.object_bytes > limits_.max_bytes) {
    throw FormatError(key.type + " '" + key.name + "' has more than " +
                      std::to_string(limits_.max_bytes) +
                      " bytes; raise RootLimits::max_bytes if this is meant");
  }
  if (key.bytes < key.key_bytes) throw FormatError("a record is shorter than its head");
  // ROOT does not pack an object that would not become shorter.
  const std::size_t bytes = std::min(key.bytes - key.key_bytes, key.object_bytes);
  std::string packed = read(key.seek + key.key_bytes, bytes);
  if (bytes == key.object_bytes) return packed;
  return unpack(packed, key.object_bytes);
}

std::optional<Key> Container::streamer_infos() {
  if (infos_ == 0) return std::nullopt;
  return key_at(infos_);
}

}  // namespace root

bool is_root_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream stream(path, std::ios::binary);
  std::string head(root::magic.size(), '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return stream && head == root::magic;
}

}  // namespace navjit
