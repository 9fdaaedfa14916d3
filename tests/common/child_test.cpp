#include "common/child.hpp"

#include <gtest/gtest.h>

namespace navjit::common {
namespace {

ChildResult shell(const std::string& script, double seconds = 30) {
  return run_child({"/bin/sh", "-c", script}, seconds);
}

TEST(Child, GivesStatusAndOutput) {
  const ChildResult good = shell("echo out; echo err >&2");
  EXPECT_TRUE(good.good());
  EXPECT_EQ(good.output, "out\n");
  EXPECT_EQ(good.error, "err\n");
  EXPECT_EQ(good.words(1), "");
  const ChildResult bad = shell("echo first >&2; echo why >&2; exit 3");
  EXPECT_FALSE(bad.good());
  EXPECT_EQ(bad.status, 3);
  EXPECT_EQ(bad.words(1), "why");
}

TEST(Child, ReadsMoreThanAPipeHolds) {
  EXPECT_EQ(shell("head -c 1000000 /dev/zero").output.size(), 1000000u);
}

TEST(Child, EndsWhatWritesMoreThanIsKept) {
  EXPECT_TRUE(shell("head -c 16777216 /dev/zero").good());
  for (const char* script : {"head -c 16777217 /dev/zero", "exec cat /dev/zero"}) {
    const ChildResult result = shell(script);
    EXPECT_FALSE(result.good()) << script;
    EXPECT_EQ(result.end, ChildResult::End::wrote_too_much) << script;
    EXPECT_NE(result.words(1).find("more than 16 MB"), std::string::npos) << result.words(1);
  }
}

TEST(Child, TellsACrash) {
  const ChildResult result = shell("kill -SEGV $$");
  EXPECT_EQ(result.end, ChildResult::End::crashed);
  EXPECT_EQ(result.words(1), "crashes (signal 11)");
}

TEST(Child, EndsWhatHangs) {
  for (const char* script : {"exec sleep 600", "exec sleep 600 >/dev/null 2>&1"}) {
    const ChildResult result = shell(script, 0.2);
    EXPECT_EQ(result.end, ChildResult::End::timed_out) << script;
    EXPECT_EQ(result.words(0.2), "hangs (0.2 s)");
  }
}

TEST(Child, SaysThatAProgramIsNotThere) {
  EXPECT_EQ(run_child({"/nonexistent/program"}, 1).words(1), "cannot be started");
}

}  // namespace
}  // namespace navjit::common
