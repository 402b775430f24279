#include "base/numeric/running_moments.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(RunningMomentsTest, SpreadFarFromZeroIsNotLost) {
  RunningMoments<double> moments;
  double count = 0;
  for (const double value : {4.0, 7.0, 13.0, 16.0}) moments.add(1e9 + value, ++count);
  EXPECT_EQ(moments.mean, 1e9 + 10);
  EXPECT_EQ(moments.squares, 90);  // in sums of squares, of 4e18, it would be lost
}

}  // namespace
}  // namespace rnmbake
