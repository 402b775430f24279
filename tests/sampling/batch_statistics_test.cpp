#include "sampling/batch_statistics.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Two texels, three batches of two samples: means and errors as from the formulas.
TEST(BatchStatisticsTest, MeansAndErrorsAreThoseOfTheBatches) {
  BatchStatistics statistics(2, 1);
  for (const auto& [first, second] : {std::pair{1.0F, 2.0F}, std::pair{2.0F, 6.0F}, std::pair{6.0F, 1.0F}}) {
    *statistics.texel(0) += Vec3(2 * first);  // the sum of two samples
    *statistics.texel(1) += Vec3(2 * second);
    statistics.end_batch(2);
  }
  EXPECT_EQ(statistics.batches(), 3);
  EXPECT_FLOAT_EQ(statistics.mean(0, 0).x, 3);
  EXPECT_FLOAT_EQ(statistics.squared_error(0, 0).x, 14.0F / 6);    // deviations -2, -1, 3
  EXPECT_FLOAT_EQ(statistics.whole_mean(0).y, 3);                  // of 1.5, 4, 3.5
  EXPECT_FLOAT_EQ(statistics.whole_squared_error(0).y, 3.5F / 6);  // deviations -1.5, 1, 0.5
}

TEST(BatchStatisticsTest, OneBatchHasNoError) {
  BatchStatistics statistics(1, 1);
  *statistics.texel(0) += Vec3(5);
  statistics.end_batch(1);
  EXPECT_EQ(statistics.squared_error(0, 0), Vec3(0));
}

}  // namespace
}  // namespace rnmbake
