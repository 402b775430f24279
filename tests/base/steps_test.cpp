#include "base/steps.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

struct HandClock : Clock {
  [[nodiscard]] double now() const override { return seconds; }
  double seconds = 1000;
};

TEST(Steps, SayNothingBeforeATenthIsDone) {
  HandClock clock;
  Steps steps(3, 100, clock);
  steps.begin("reading", 1);
  EXPECT_LT(steps.seconds_left(), 0);
  clock.seconds += 20;
  steps.begin("baking", 19);
  EXPECT_LT(steps.seconds_left(), 0) << "one of a hundred took 20 s, but that says nothing of the others";
  clock.seconds += 20;
  steps.begin("tracing", 80);
  EXPECT_DOUBLE_EQ(steps.seconds_left(), 160);
}

}  // namespace
}  // namespace rnmbake
