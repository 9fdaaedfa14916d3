// ROOT files as containers, intact and damaged.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/root_reading.hpp"

namespace navjit {
namespace {

using namespace tests;

class RootFile : public RootReading {
 protected:
  static RootPointer geometry(const std::string& inner) {
    const RootPointer leaf = root_volume(inner, root_box("leafbox", 1, 1, 1));
    std::vector<RootPointer> nodes;
    for (int i = 0; i < 20; ++i) {
      nodes.push_back(
          root_node("leaf_" + std::to_string(i), leaf, i, root_translation(3 * i, 0, 0)));
    }
    return root_manager(root_volume("world", root_box("hall", 500, 50, 50), nodes));
  }
};

TEST_F(RootFile, IsReadHoweverItIsPacked) {
  for (const RootPacking packing : {RootPacking::none, RootPacking::zlib, RootPacking::deflate,
                                    RootPacking::lzma, RootPacking::lz4, RootPacking::zstd}) {
    const std::string bytes = root_file({{"g", geometry("leaf")}}, packing);
    const Detector detector = read_bytes(bytes);
    EXPECT_EQ(detector.touchables(), 21U) << static_cast<int>(packing);
    EXPECT_EQ(detector.volume(detector.world_volume()).daughters[19].name, "leaf_19");
    EXPECT_TRUE(is_root_file(file_));
    if (packing == RootPacking::none) continue;
    // Damage within the packed geometry, which comes first.
    std::string damaged = bytes;
    damaged.replace(350, 40, std::string(40, '\x55'));
    EXPECT_NE(refusal_of_bytes(damaged), "") << static_cast<int>(packing);
  }
}

TEST_F(RootFile, GeometriesAreFoundByName) {
  const std::vector<RootEntry> entries{{"first", geometry("one")},
                                       {"second", geometry("two")},
                                       {"first", geometry("newer"), 2},
                                       {"loose", root_volume("alone", root_box("b", 1, 1, 1))}};
  for (const std::string folder : {"", "folder"}) {
    const std::string bytes = root_file(entries, RootPacking::zlib, folder);
    EXPECT_TRUE(read_bytes(bytes).find_volume("newer"));
    EXPECT_TRUE(read_bytes(bytes, {.key = "second"}).find_volume("two"));
    EXPECT_EQ(read_bytes(bytes, {.key = "loose"}).volumes(), 1U);
    const std::string message = refusal_of_bytes(bytes, {.key = "third"});
    EXPECT_NE(message.find("no geometry 'third'; choose one of 'first', 'second', 'loose'"),
              std::string::npos)
        << message;
  }
  EXPECT_EQ(read_bytes(root_file({entries[3]})).volumes(), 1U);
  const RootPointer histogram = root_object("TH1F", "counts", {});
  EXPECT_NE(refusal_of_bytes(root_file({{"counts", histogram}})).find("there is no geometry"),
            std::string::npos);
}

TEST_F(RootFile, ErrorsNameTheFile) {
  EXPECT_EQ(refusal_of_bytes("no root file"), file_ + ": it is no ROOT file");
  EXPECT_EQ(refusal_of_bytes("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n"),
            file_ +
                ": cannot be read: it is a Git LFS pointer, not the file itself; 'git lfs pull' "
                "fetches that");
  EXPECT_NE(refusal_of_bytes("root"), "");
  EXPECT_THROW(read_root(folder_.file("none.root")), RootError);
  EXPECT_THROW(read_root(folder_.path()), RootError);
  EXPECT_FALSE(is_root_file(folder_.file("none.root")));
  EXPECT_FALSE(is_root_file(folder_.path()));
}

TEST_F(RootFile, LimitsHold) {
  const std::string bytes = root_file({{"g", geometry("leaf")}}, RootPacking::zlib);
  EXPECT_NE(refusal_of_bytes(bytes, {.limits = {.max_bytes = 1000}}).find("max_bytes"),
            std::string::npos);
  EXPECT_NE(refusal_of_bytes(bytes, {.limits = {.max_keys = 0}}).find("max_keys"),
            std::string::npos);
  EXPECT_NE(refusal_of_bytes(bytes, {.limits = {.max_placements = 19}}).find("max_placements"),
            std::string::npos);
  EXPECT_EQ(refusal_of_bytes(bytes, {.limits = {.max_placements = 20}}), "");
}

TEST_F(RootFile, IsNotReadBeyondItsEnd) {
  const std::string bytes = root_file({{"g", geometry("leaf")}});
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    EXPECT_NE(refusal_of_bytes(bytes.substr(0, length)), "") << length;
  }
}

/// Whatever is wrong in a file, there is a detector or an error.
TEST_F(RootFile, BrokenFilesGiveErrors) {
  std::mt19937_64 random(1);
  const std::string whole = root_file({{"g", geometry("leaf")}});
  int errors = 0;
  constexpr int turns = 1000;
  for (int i = 0; i < turns; ++i) {
    std::string bytes = whole;
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes[at] = static_cast<char>(bytes[at] ^ 1 << random() % 8);
          break;
        case 2:
          bytes[at] = random() % 2 == 0 ? '\0' : '\xff';
          break;
        default: {
          const std::size_t from = random() % bytes.size();
          const std::size_t count =
              std::min({random() % 16, bytes.size() - from, bytes.size() - at});
          bytes.replace(at, count, bytes.substr(from, count));
        }
      }
    }
    errors += refusal_of_bytes(bytes, {.limits = {.max_bytes = 1 << 24}}).empty() ? 0 : 1;
  }
  EXPECT_GT(errors, turns / 10);
  EXPECT_LT(errors, turns);
}

}  // namespace
}  // namespace navjit
