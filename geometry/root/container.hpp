// A ROOT file as a container: what it holds, by name and class, and the bytes of each object.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "geometry/root/bytes.hpp"

namespace navjit::root {

/// One object of the file.
struct Key {
  std::string type, name;
  int cycle = 0;                   ///< of objects of one name, the newer has the higher cycle
  std::uint64_t seek = 0;          ///< where its record begins
  std::uint32_t bytes = 0;         ///< length of the record in the file
  std::uint32_t object_bytes = 0;  ///< length of the object, unpacked
  std::uint16_t key_bytes = 0;     ///< length of what stands before the object
};

/// An open file. All functions throw FormatError.
class Container {
 public:
  Container(const std::filesystem::path& path, const RootLimits& limits);

  /// The keys of the file and of its folders, in order; of several cycles of a name, the newest.
  const std::vector<Key>& keys() const { return keys_; }
  /// The object's bytes, unpacked.
  std::string object(const Key& key);
  /// The list of StreamerInfos, which describe the classes; nothing if the file has none.
  std::optional<Key> streamer_infos();

 private:
  std::string read(std::uint64_t at, std::size_t count);
  Key key_at(std::uint64_t at);
  /// Reads the keys of the folder whose own record is at `seek`.
  void read_folder(std::uint64_t seek, std::size_t before, int depth);

  const RootLimits& limits_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, infos_ = 0, list_bytes_ = 0;
  std::size_t records_ = 0;
  std::vector<Key> keys_;
};

}  // namespace navjit::root
