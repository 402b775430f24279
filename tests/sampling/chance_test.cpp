#include "support/chance.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Of ten tosses of a coin: 1, 10, 45, 120, 210 and 252 of the 1024 outcomes have 0 to 5 heads.
TEST(Chance, BinomialTailsOfACoin) {
  const double outcomes[] = {1, 11, 56, 176, 386, 638};
  for (int heads = 0; heads <= 5; ++heads)
    EXPECT_NEAR(binomial_at_most(heads, 10, 0.5), outcomes[heads] / 1024, 1e-12) << heads;
  EXPECT_NEAR(binomial_at_most(10, 10, 0.5), 1, 1e-12);
}

/// By themselves: 0.95^100 for none missed, and the sum of the terms.
TEST(Chance, BinomialTailsOfIntervals) {
  EXPECT_NEAR(binomial_at_most(0, 100, 0.05), std::pow(0.95, 100), 1e-12);
  EXPECT_NEAR(binomial_at_most(1, 100, 0.05), std::pow(0.95, 100) + 5 * std::pow(0.95, 99), 1e-12);
  EXPECT_NEAR(binomial_at_most(89, 100, 0.95), 0.0115, 5e-5);  // tables of the binomial distribution
}

/// The 97.5 % points of the tables.
TEST(Chance, StudentsTable) {
  for (const auto& [freedom, point] :
       {std::pair{1, 12.7062}, {2, 4.30265}, {3, 3.18245}, {10, 2.22814}, {15, 2.13145}, {30, 2.04227}})
    EXPECT_NEAR(student_within(point, freedom), 0.95, 1e-6) << freedom;
}

/// A coin that comes down heads ten times of ten has a chance of 1/1024; of 5 %, each tail gets half.
TEST(Chance, BoundsHoldWhatChanceExplains) {
  const CountBounds coin = count_bounds(10, 0.5, 0.5, 0.05);
  EXPECT_EQ(coin.fewest, 2);  // 11 of 1024 are fewer, 56 would be more than 2.5 %
  EXPECT_EQ(coin.most, 8);
  EXPECT_EQ(count_bounds(100, 0.95).most, 100) << "too few trials: all 100 hold with a chance of 0.6 %";
}

TEST(Chance, BoundsAreTheNarrowestWithTheirFalseAlarm) {
  for (const double probability : {0.5, 0.93, 0.95}) {
    for (const int trials : {100, 1000, 4000}) {
      const auto [fewest, most] = count_bounds(trials, probability);
      EXPECT_LE(binomial_at_most(fewest - 1, trials, probability), 5e-7);
      EXPECT_GT(binomial_at_most(fewest, trials, probability), 5e-7);
      EXPECT_LE(binomial_at_most(trials - most - 1, trials, 1 - probability), 5e-7);
      EXPECT_GT(binomial_at_most(trials - most, trials, 1 - probability), 5e-7);
    }
  }
  const auto [fewest, most] = count_bounds(1000, 0.93, 0.95);
  EXPECT_EQ(fewest, count_bounds(1000, 0.93).fewest);
  EXPECT_EQ(most, count_bounds(1000, 0.95).most);
}

}  // namespace
}  // namespace rnmbake
