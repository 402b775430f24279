#include "process/stall.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// SurfaceMaterials every quarter of a second until `until`, CPU time growing by `share` of a core.
void watch_quietly(StallWatch& watch, double until, double share, bool wants_core) {
  for (double now = 0.25; now <= until; now += 0.25) watch.observe(now, now * share, wants_core, false);
}

TEST(StallWatch, IdleTimeCountsInFull) {
  StallWatch watch(0);
  watch_quietly(watch, 10, 0.01, false);
  EXPECT_DOUBLE_EQ(watch.stalled_seconds(), 10);
}

TEST(StallWatch, ALoopWithoutEndIsNoLife) {
  StallWatch one(0), many(0);
  watch_quietly(one, 10, 1, true);
  watch_quietly(many, 10, 16, true);  // sixteen threads stall no faster than one
  EXPECT_DOUBLE_EQ(one.stalled_seconds(), 10);
  EXPECT_DOUBLE_EQ(many.stalled_seconds(), 10);
}

TEST(StallWatch, WaitingForACoreDoesNotCount) {
  StallWatch watch(0);
  watch_quietly(watch, 100, 1.0 / 11, true);  // a machine with eleven times as much to do
  EXPECT_NEAR(watch.stalled_seconds(), 100.0 / 11, 1e-9);
}

TEST(StallWatch, ProgressBeginsAnew) {
  StallWatch watch(0);
  watch_quietly(watch, 5, 1, true);
  watch.observe(5.25, 5.25, true, true);
  EXPECT_DOUBLE_EQ(watch.stalled_seconds(), 0);
  watch.observe(6, 6, true, false);
  EXPECT_DOUBLE_EQ(watch.stalled_seconds(), 0.75);
}

TEST(StallWatch, OurOwnAbsenceIsNotHeldAgainstIt) {
  StallWatch watch(0);
  watch.observe(3600, 0, false, false);  // Ctrl-Z, or a lid that was closed
  EXPECT_DOUBLE_EQ(watch.stalled_seconds(), StallWatch::longest_gap);
}

TEST(StallWatch, ChildrenThatEndTakeTheirTimeWithThem) {
  StallWatch watch(0);
  watch.observe(1, 100, true, true);
  watch.observe(2, 1, true, false);
  watch.observe(3, 2, true, false);
  EXPECT_DOUBLE_EQ(watch.stalled_seconds(), 1);
}

}  // namespace
}  // namespace rnmbake
