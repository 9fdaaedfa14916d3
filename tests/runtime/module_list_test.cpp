#include "runtime/module_list.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace navjit {
namespace {

TEST(ModuleList, ReadsWhatItWrites) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    ModuleList list;
    std::vector<VolumeId> volumes(50);
    for (VolumeId v = 0; v < volumes.size(); ++v) volumes[v] = v;
    std::shuffle(volumes.begin(), volumes.end(), random);
    for (std::size_t at = 0; at < volumes.size();) {
      const std::size_t n = std::min<std::size_t>(1 + random() % 12, volumes.size() - at);
      ListedModule& module = list.emplace_back();
      for (auto& scenes = module.scenes; scenes.size() < n; ++at) {
        scenes.push_back({volumes[at]});
        if (random() % 3 == 0) scenes.back().search = Candidates::scan;
        if (random() % 5 == 0) scenes.back().search = Candidates::slabs;
      }
      // Beside it, any that are not in it.
      for (std::size_t k = at; k < volumes.size() && random() % 2 == 0; ++k) {
        module.beside.push_back({volumes[k], Candidates::rings});
      }
    }
    const std::string text = write_module_list(list);
    EXPECT_EQ(read_module_list(text, 50), list);
    EXPECT_FALSE(read_module_list(text, 49)) << "a volume that does not exist";
    EXPECT_FALSE(read_module_list(text + text, 50));
    // Whatever is cut off: nothing, or fewer batches.
    const auto cut = read_module_list(text.substr(0, random() % text.size()), 50);
    EXPECT_TRUE(!cut || cut->size() < list.size());
  }
  EXPECT_EQ(read_module_list(write_module_list({}), 0), ModuleList{});
  for (const char* scene :
       {"1:", "1:2", "1:wires", "1:scan:scan", ":scan", "1 :scan", "1:scan,", "1|", "|1:scan",
        "1|2", "1|1:scan", "1|2:scan|3:scan", "1|2:scan 2:scan", "1|9:scan"}) {
    EXPECT_FALSE(read_module_list(std::string("navjit hot scenes 3\n") + scene + "\n", 9)) << scene;
  }
}

TEST(ModuleList, MergedBatchesShareNoVolume) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 200; ++round) {
    ModuleList lists[2];
    for (ModuleList& list : lists) {
      std::set<VolumeId> seen;
      for (int b = 0; b < 5; ++b) {
        ListedModule module;
        for (int i = 0; i < 3; ++i) {
          const auto v = static_cast<VolumeId>(random() % 30);
          if (seen.insert(v).second) module.scenes.push_back({v});
        }
        if (!module.scenes.empty()) list.push_back(module);
      }
    }
    const ModuleList merged = merge(lists[0], lists[1]);
    EXPECT_TRUE(read_module_list(write_module_list(merged), 30));
    ASSERT_GE(merged.size(), lists[0].size());
    for (std::size_t b = 0; b < lists[0].size(); ++b) EXPECT_EQ(merged[b], lists[0][b]);
    EXPECT_EQ(merge(merged, lists[1]), merged);
  }
}

TEST(ModuleList, AScenesNextModuleIsListedBesideItsFirst) {
  const ModuleList list{{{{17}, {12}}}, {{{12}}}, {{{12, Candidates::rings}, {3}}}};
  EXPECT_EQ(read_module_list(write_module_list(list), 20), list);
  EXPECT_FALSE(read_module_list(write_module_list({{{{12}, {12}}}}), 20)) << "twice in one";
  EXPECT_FALSE(read_module_list(write_module_list(ModuleList(100, ListedModule{{{1}}})), 20))
      << "without end";
}

}  // namespace
}  // namespace navjit
