#include "process/silence.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(SilenceWatch, CpuTimeBelowTheThresholdIsSilence) {
  SilenceWatch watch(0);
  for (int tick = 1; tick <= 40; ++tick) watch.observe(tick * 0.25, tick * 0.25 * 0.04, 0, false);
  EXPECT_DOUBLE_EQ(watch.silent_seconds(10), 10);
}

TEST(SilenceWatch, CpuTimeAboveItIsLife) {
  SilenceWatch watch(0);
  for (int tick = 1; tick <= 40; ++tick) watch.observe(tick * 0.25, tick * 0.25 * 0.06, 0, false);
  EXPECT_DOUBLE_EQ(watch.silent_seconds(10), 0);
}

TEST(SilenceWatch, LongWindowsNeedMoreCpuTime) {
  SilenceWatch watch(0);
  watch.observe(10, 0.3, 0, false);
  EXPECT_DOUBLE_EQ(watch.silent_seconds(10), 10);
}

TEST(SilenceWatch, OutputAndProgressCountAtOnce) {
  SilenceWatch watch(0);
  watch.observe(0.5, 0, 10, false);
  EXPECT_DOUBLE_EQ(watch.silent_seconds(1), 0.5);
  watch.observe(5, 0, 10, false);
  EXPECT_DOUBLE_EQ(watch.silent_seconds(5), 4.5);
  watch.observe(6, 0, 10, true);
  EXPECT_DOUBLE_EQ(watch.silent_seconds(6), 0);
}

}  // namespace
}  // namespace rnmbake
