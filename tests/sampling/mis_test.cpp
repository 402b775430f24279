#include "sampling/mis.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(MisTest, WeightsOfBothStrategiesSumToOne) {
  for (const float a : {0.01F, 1.0F, 30.0F}) {
    for (const float b : {0.2F, 1.0F, 5.0F}) {
      EXPECT_FLOAT_EQ(balance_heuristic(a, b) + balance_heuristic(b, a), 1);
      EXPECT_FLOAT_EQ(power_heuristic(a, b) + power_heuristic(b, a), 1);
    }
  }
  EXPECT_FLOAT_EQ(balance_heuristic(3, 1), 0.75F);
  EXPECT_FLOAT_EQ(power_heuristic(3, 1), 0.9F);
}

}  // namespace
}  // namespace rnmbake
