// Writes ROOT files, as small and as odd as a test needs them. Each class is described by the
// members of its first object.
#pragma once

#include <lz4.h>
#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace navjit::tests {

struct RootObject;
using RootPointer = std::shared_ptr<RootObject>;

/// The kinds of members of an object; see the functions below.
struct RootBase {
  RootPointer part;
};
struct RootList {
  std::vector<RootPointer> objects;
};
struct RootCounted {
  std::string counter;  ///< written before the numbers, unless it is empty
  std::vector<double> numbers;
};
/// A std::vector of objects, without names, of a class that has no versions.
struct RootVector {
  std::string of;
  std::vector<RootPointer> objects;
  bool by_members = true;  ///< one member of all objects after the other
};
using RootValue = std::variant<double, int, std::vector<double>, std::vector<int>, RootCounted,
                               RootPointer, RootList, RootBase, RootVector>;

/// An object: its class, TNamed's name and TObject's bits, then members. If `named` is false, the
/// class has no TNamed.
struct RootObject {
  std::string type, name{};
  std::vector<std::pair<std::string, RootValue>> members{};
  std::uint32_t bits = 0x03000000;
  bool named = true;
};

inline RootPointer root_object(std::string type, std::string name,
                               std::vector<std::pair<std::string, RootValue>> members,
                               std::uint32_t bits = 0x03000000) {
  return std::make_shared<RootObject>(
      RootObject{std::move(type), std::move(name), std::move(members), bits});
}

/// The checksum by which a class without versions is known.
inline std::size_t root_checksum_of(const std::string& type) {
  return std::hash<std::string>()(type) & 0xffffffff;
}

enum class RootPacking { none, zlib, deflate, lzma, lz4, zstd };

/// Bytes as ROOT writes them.
class RootBytes {
 public:
  std::string bytes;

  template <class Unsigned>
  void number(Unsigned value) {
    for (int shift = 8 * static_cast<int>(sizeof value) - 8; shift >= 0; shift -= 8) {
      bytes += static_cast<char>(value >> shift & 0xff);
    }
  }
  void u8(unsigned value) { number(static_cast<std::uint8_t>(value)); }
  void u16(unsigned value) { number(static_cast<std::uint16_t>(value)); }
  void u32(std::size_t value) { number(static_cast<std::uint32_t>(value)); }
  void f64(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void text(const std::string& text) {
    if (text.size() < 255) {
      u8(static_cast<unsigned>(text.size()));
    } else {
      u8(255);
      u32(text.size());
    }
    bytes += text;
  }
  /// Writes a length before what `body` writes.
  template <class Body>
  void counted(Body&& body) {
    const std::size_t at = bytes.size();
    u32(0);
    body();
    patch(at, (bytes.size() - at - 4) | 0x40000000);
  }
  template <class Body>
  void versioned(unsigned version, Body&& body) {
    counted([&] {
      u16(version);
      body();
    });
  }
  void patch(std::size_t at, std::size_t value) {
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[at + i] = static_cast<char>(value >> (24 - 8 * i) & 0xff);
    }
  }
  void object(std::uint32_t bits) {
    u16(1);
    u32(0);
    u32(bits);
  }
  void named(const std::string& name, std::uint32_t bits) {
    versioned(1, [&] {
      object(bits);
      text(name);
      text("");
    });
  }
};

/// A record's object, with pointers between objects.
class RootRecord : public RootBytes {
 public:
  explicit RootRecord(std::size_t key_bytes) : key_bytes_(key_bytes) {}

  /// Classes and what they have, in the order in which they were met.
  std::vector<RootPointer> classes;

  void top(const RootPointer& object) {
    known_[object.get()] = 1;
    part(*object, object);
  }
  /// Of a class that `body` writes.
  template <class Body>
  void pointer_to(const std::string& type, Body&& body) {
    counted([&] {
      const auto [found, added] = class_places_.try_emplace(type, place());
      if (added) {
        u32(0xffffffff);
        bytes += type;
        bytes += '\0';
      } else {
        u32(found->second | 0x80000000);
      }
      body();
    });
  }
  void pointer(const RootPointer& object) {
    if (!object) return u32(0);
    const auto [found, added] = known_.try_emplace(object.get(), place());
    if (!added) return u32(found->second);
    pointer_to(object->type, [&] { part(*object, object); });
  }
  void list(const std::vector<RootPointer>& objects) {
    pointer_to("TObjArray", [&] {
      versioned(3, [&] {
        object(0x03000000);
        text("");
        u32(objects.size());
        u32(0);
        for (const RootPointer& object : objects) pointer(object);
      });
    });
  }

 private:
  std::size_t place() const { return bytes.size() + key_bytes_ + 2; }

  void describe(const RootPointer& it) {
    bool is_new = true;
    for (const RootPointer& known : classes) is_new = is_new && known->type != it->type;
    if (is_new) classes.push_back(it);
  }
  void part(const RootObject& it, const RootPointer& pointer_to_it) {
    describe(pointer_to_it);
    versioned(1, [&] {
      if (it.named) named(it.name, it.bits);
      for (std::size_t i = 0; i < it.members.size(); ++i) write_member(it, i);
    });
  }
  void write(double value) { f64(value); }
  void write(int value) { u32(static_cast<std::uint32_t>(value)); }
  void write(const std::vector<double>& values) {
    for (const double value : values) f64(value);
  }
  void write(const std::vector<int>& values) {
    for (const int value : values) write(value);
  }
  void write(const RootCounted& values) {
    if (!values.counter.empty()) u32(values.numbers.size());
    u8(1);
    write(values.numbers);
  }
  void write(const RootPointer& object) { pointer(object); }
  void write(const RootList& objects) { list(objects.objects); }
  void write_member(const RootObject& it, std::size_t member) {
    std::visit([&](const auto& value) { write(value); }, it.members[member].second);
  }
  void write(const RootVector& vector) {
    const std::vector<RootPointer>& objects = vector.objects;
    if (!objects.empty()) describe(objects.front());
    const auto no_version = [&] {
      u16(0);
      u32(root_checksum_of(vector.of));
    };
    versioned(vector.by_members ? 9 | 1U << 14 : 9, [&] {
      if (vector.by_members) no_version();
      u32(objects.size());
      const std::size_t members = objects.empty() ? 0 : objects.front()->members.size();
      for (std::size_t i = 0; vector.by_members && i < members; ++i) {
        for (const RootPointer& object : objects) write_member(*object, i);
      }
      for (std::size_t i = 0; !vector.by_members && i < objects.size(); ++i) {
        counted([&] {
          no_version();
          for (std::size_t k = 0; k < members; ++k) write_member(*objects[i], k);
        });
      }
    });
  }
  void write(const RootBase& base) { part(*base.part, base.part); }

  std::size_t key_bytes_;
  std::map<const RootObject*, std::size_t> known_;
  std::map<std::string, std::size_t> class_places_;
};

/// One member of a class, as StreamerInfos hold it. `more`: its counter, or the type in a vector.
inline void root_element(RootRecord& record, const std::string& type, const std::string& name,
                         unsigned number, std::size_t length, const std::string& more = {}) {
  record.pointer_to(type, [&] {
    const bool is_base = type == "TStreamerBase", is_vector = type == "TStreamerSTL";
    record.versioned(is_base ? 3 : 2, [&] {
      record.versioned(4, [&] {
        record.named(name, 0x03000000);
        record.u32(number);
        record.u32(0);
        record.u32(length);
        record.u32(length > 0 ? 1 : 0);
        for (int i = 0; i < 5; ++i) record.u32(0);
        record.text(is_base ? "BASE" : is_vector ? "vector<" + more + ">" : "");
      });
      if (is_base) record.u32(1);
      if (type == "TStreamerBasicPointer") {
        record.u32(1);
        record.text(more);
        record.text("");
      }
      if (is_vector) {
        record.u32(1);   // a vector
        record.u32(61);  // of objects
      }
    });
  });
}

inline void root_elements(RootRecord& record, const RootObject& it) {
  std::size_t count = it.named ? 1 : 0;
  for (const auto& [name, value] : it.members) {
    const auto* counted = std::get_if<RootCounted>(&value);
    count += counted != nullptr && !counted->counter.empty() ? 2 : 1;
  }
  record.pointer_to("TObjArray", [&] {
    record.versioned(3, [&] {
      record.object(0x03000000);
      record.text("");
      record.u32(count);
      record.u32(0);
      if (it.named) root_element(record, "TStreamerBase", "TNamed", 67, 0);
      for (const auto& [name, value] : it.members) {
        if (std::holds_alternative<double>(value)) {
          root_element(record, "TStreamerBasicType", name, 8, 0);
        } else if (std::holds_alternative<int>(value)) {
          root_element(record, "TStreamerBasicType", name, 3, 0);
        } else if (const auto* fixed = std::get_if<std::vector<double>>(&value)) {
          root_element(record, "TStreamerBasicType", name, 28, fixed->size());
        } else if (const auto* whole = std::get_if<std::vector<int>>(&value)) {
          root_element(record, "TStreamerBasicType", name, 23, whole->size());
        } else if (const auto* vector = std::get_if<RootVector>(&value)) {
          root_element(record, "TStreamerSTL", name, 500, 0, vector->of);
        } else if (const auto* counted = std::get_if<RootCounted>(&value)) {
          if (!counted->counter.empty()) {
            root_element(record, "TStreamerBasicType", counted->counter, 6, 0);
          }
          // Of those that share a counter the first has it.
          std::string counter = counted->counter;
          for (const auto& other : it.members) {
            const auto* first = std::get_if<RootCounted>(&other.second);
            if (counter.empty() && first != nullptr) counter = first->counter;
          }
          root_element(record, "TStreamerBasicPointer", name, 48, 0, counter);
        } else if (const auto* base = std::get_if<RootBase>(&value)) {
          root_element(record, "TStreamerBase", base->part->type, 0, 0);
        } else {
          root_element(record, "TStreamerObjectPointer", name, 64, 0);
        }
      }
    });
  });
}

inline std::string root_packed(const std::string& bytes, RootPacking packing) {
  if (packing == RootPacking::none) return bytes;
  std::string out(bytes.size() + 1000, '\0');
  auto* to = reinterpret_cast<std::uint8_t*>(out.data());
  const auto* from = reinterpret_cast<const std::uint8_t*>(bytes.data());
  std::string method;
  std::size_t size = 0;
  if (packing == RootPacking::zlib || packing == RootPacking::deflate) {
    z_stream stream{};
    const int window = packing == RootPacking::zlib ? MAX_WBITS : -MAX_WBITS;
    deflateInit2(&stream, 6, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = const_cast<Bytef*>(from);
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = to;
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    size = stream.total_out;
    deflateEnd(&stream);
    method = packing == RootPacking::zlib ? "ZL" : "CS";
  } else if (packing == RootPacking::lzma) {
    if (lzma_easy_buffer_encode(1, LZMA_CHECK_CRC32, nullptr, from, bytes.size(), to, &size,
                                out.size()) != LZMA_OK) {
      throw std::runtime_error("LZMA does not pack");
    }
    method = "XZ";
  } else if (packing == RootPacking::lz4) {
    // A checksum, which nobody reads, comes first.
    size = 8 + static_cast<std::size_t>(LZ4_compress_default(bytes.data(), out.data() + 8,
                                                             static_cast<int>(bytes.size()),
                                                             static_cast<int>(out.size() - 8)));
    method = "L4";
  } else {
    size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1);
    method = "ZS";
  }
  const auto three = [](std::size_t value) {
    std::string text;
    for (int i = 0; i < 3; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
  };
  const bool deflated = packing == RootPacking::zlib || packing == RootPacking::deflate;
  return method + (deflated ? '\x8' : '\1') + three(size) + three(bytes.size()) +
         out.substr(0, size);
}

/// An object of a file, with its name and cycle.
struct RootEntry {
  std::string name;
  RootPointer object;
  unsigned cycle = 1;
};

/// A file with these objects and, if `folder` has a name, with others in that folder.
inline std::string root_file(const std::vector<RootEntry>& entries,
                             RootPacking packing = RootPacking::none,
                             const std::string& folder = {}) {
  constexpr std::size_t begin = 100;
  RootBytes file;
  file.bytes.assign(begin, '\0');
  std::vector<RootPointer> classes;
  // Key: what stands before each record, and again in the list of a folder.
  const auto key_size = [](const std::string& type, const std::string& name) {
    return 26 + 3 + type.size() + name.size();
  };
  const auto key = [&](RootBytes& to, std::size_t bytes, std::size_t object_bytes, unsigned cycle,
                       std::size_t seek, const std::string& type, const std::string& name) {
    to.u32(bytes);
    to.u16(4);
    to.u32(object_bytes);
    to.u32(0);
    to.u16(static_cast<unsigned>(key_size(type, name)));
    to.u16(cycle);
    to.u32(seek);
    to.u32(begin);
    to.text(type);
    to.text(name);
    to.text("");
  };
  const auto record = [&](RootBytes* list, const std::string& type, const std::string& name,
                          unsigned cycle, const std::string& object) {
    const std::string packed = root_packed(object, packing);
    const std::size_t bytes = key_size(type, name) + packed.size(), seek = file.bytes.size();
    key(file, bytes, object.size(), cycle, seek, type, name);
    file.bytes += packed;
    if (list != nullptr) key(*list, bytes, object.size(), cycle, seek, type, name);
    return std::pair{seek, bytes};
  };
  const auto folder_record = [](RootBytes& to, std::size_t list_bytes, std::size_t list_at) {
    to.u16(5);
    to.u32(0);
    to.u32(0);
    to.u32(list_bytes);
    to.u32(0);
    to.u32(begin);
    to.u32(0);
    to.u32(list_at);
  };
  // The file's own record; where its list of keys is comes later.
  const std::string file_name = "file.root";
  key(file, 0, 0, 1, begin, "TFile", file_name);
  file.text(file_name);
  file.text("");
  const std::size_t folder_at = file.bytes.size();
  folder_record(file, 0, 0);

  RootBytes list;
  for (const RootEntry& entry : entries) {
    RootRecord object(key_size(entry.object->type, entry.name));
    object.classes = classes;
    object.top(entry.object);
    classes = object.classes;
    record(&list, entry.object->type, entry.name, entry.cycle, object.bytes);
  }
  std::size_t count = entries.size();
  const auto write_list = [&] {
    RootBytes all;
    key(all, 0, 0, 1, 0, "TFile", file_name);
    all.u32(count);
    const std::size_t at = file.bytes.size();
    file.bytes += all.bytes + list.bytes;
    return std::pair{at, all.bytes.size() + list.bytes.size()};
  };
  if (!folder.empty()) {
    const auto [at, bytes] = write_list();
    RootBytes inner;
    folder_record(inner, bytes, at);
    RootBytes outer;
    const std::size_t seek = file.bytes.size();
    const std::size_t size = key_size("TDirectory", folder) + inner.bytes.size();
    key(file, size, inner.bytes.size(), 1, seek, "TDirectory", folder);
    file.bytes += inner.bytes;
    key(outer, size, inner.bytes.size(), 1, seek, "TDirectory", folder);
    list = outer;
    count = 1;
  }

  RootRecord infos(key_size("TList", "StreamerInfo"));
  infos.versioned(5, [&] {
    infos.object(0x03000000);
    infos.text("");
    infos.u32(classes.size());
    for (const RootPointer& it : classes) {
      infos.pointer_to("TStreamerInfo", [&] {
        infos.versioned(9, [&] {
          infos.named(it->type, 0x03000000);
          infos.u32(root_checksum_of(it->type));
          infos.u32(1);
          root_elements(infos, *it);
        });
      });
      infos.text("");
    }
  });
  const auto [infos_at, infos_bytes] = record(nullptr, "TList", "StreamerInfo", 1, infos.bytes);
  const auto [list_at, list_bytes] = write_list();
  RootBytes own;
  folder_record(own, list_bytes, list_at);
  file.bytes.replace(folder_at, own.bytes.size(), own.bytes);
  RootBytes head;
  head.bytes = "root";
  head.u32(62000);
  head.u32(begin);
  head.u32(file.bytes.size());
  head.u32(0);
  head.u32(0);
  head.u32(0);
  head.u32(folder_at - begin);
  head.u8(4);
  head.u32(0);
  head.u32(infos_at);
  head.u32(infos_bytes);
  file.bytes.replace(0, head.bytes.size(), head.bytes);
  return file.bytes;
}

}  // namespace navjit::tests
