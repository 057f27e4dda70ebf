// Intervals that are kept, and the device's clock on the host's.
#include <gtest/gtest.h>

#include "host/core/trace.h"

namespace glintmark {
namespace {

TEST(Trace, NothingIsKeptWhileItIsOff) {
  startTrace();
  stopTrace();
  {
    const TraceScope scope("frame", "unseen");
    traceCommand("kernel", "unseen", {0, 1, 2, 3}, 0, 10);
  }
  EXPECT_TRUE(hostIntervals().empty());
  EXPECT_TRUE(deviceIntervals().empty());
}

TEST(Trace, ScopesNest) {
  startTrace();
  {
    const TraceScope outer("frame", "outer");
    const TraceScope inner("frame", "inner");
  }
  stopTrace();
  const std::vector<HostInterval> intervals = hostIntervals();
  ASSERT_EQ(intervals.size(), 2u);
  EXPECT_EQ(intervals[0].name, "outer");
  EXPECT_LE(intervals[0].begin_ns, intervals[1].begin_ns);
  EXPECT_GE(intervals[0].end_ns, intervals[1].end_ns);
}

// The device's clock is 1000 ahead. The first command allows offsets from -1010 to -990, the second
// from -1002 to -994: the middle of what both allow is -998.
TEST(Trace, OneOffsetForAllCommands) {
  startTrace();
  traceCommand("kernel", "first", {1110, 1112, 1115, 1190}, 100, 200);
  traceCommand("kernel", "second", {1302, 1303, 1304, 1394}, 300, 400);
  stopTrace();
  const std::vector<DeviceInterval> intervals = deviceIntervals();
  ASSERT_EQ(intervals.size(), 2u);
  EXPECT_EQ(intervals[0].begin_ns, 1115 - 998);
  EXPECT_EQ(intervals[0].end_ns, 1190 - 998);
  EXPECT_EQ(intervals[1].begin_ns, 1304 - 998);
  EXPECT_EQ(intervals[1].queued_ns, 2);
  EXPECT_TRUE(intervals[0].fits && intervals[1].fits);
}

// Offsets from -10 to 10, then from 90 to 110: each moves to its own range's nearer end.
TEST(Trace, DriftMovesACommandByTheLeast) {
  startTrace();
  traceCommand("kernel", "early", {110, 110, 110, 190}, 100, 200);
  traceCommand("kernel", "late", {210, 210, 210, 290}, 300, 400);
  stopTrace();
  const std::vector<DeviceInterval> intervals = deviceIntervals();
  EXPECT_EQ(intervals[0].begin_ns, 110 + 10);
  EXPECT_EQ(intervals[1].begin_ns, 210 + 90);
}

// A command that took longer by its own clock than the host saw it take.
TEST(Trace, SaysWhereTheClocksContradictEachOther) {
  startTrace();
  traceCommand("kernel", "too long", {0, 0, 0, 500}, 100, 200);
  stopTrace();
  EXPECT_FALSE(deviceIntervals().at(0).fits);
}

}  // namespace
}  // namespace glintmark
