#include "bake/sample_passes.h"

#include "bake/plan.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Every half goes from `done` to `wanted` without a gap.
void expect_whole(const std::vector<SamplePass>& passes, HalfSamples done, const HalfSamples& wanted) {
  for (const SamplePass& pass : passes) {
    int& next = done[std::size_t(pass.half)];
    EXPECT_EQ(pass.first, next);
    EXPECT_GT(pass.count, 0);
    EXPECT_EQ(pass.of, wanted[std::size_t(pass.half)]);
    next += pass.count;
  }
  EXPECT_EQ(done, wanted);
}

TEST(SamplePasses, CoverBothHalvesWithoutAGap) {
  for (const double sample_seconds : {1e-5, 0.01, 1.0, 100.0}) {
    for (const int samples : {1, 2, 3, 64, 100, 4097}) {
      const HalfSamples wanted = in_halves(samples);
      EXPECT_EQ(wanted[0] + wanted[1], samples);
      expect_whole(cut_into_passes({0, 0}, wanted, {0.5, sample_seconds}), {0, 0}, wanted);
    }
  }
}

TEST(SamplePasses, GoOnFromWhatIsThere) {
  expect_whole(cut_into_passes({32, 32}, in_halves(1000), {0.5, 0.5}), {32, 32}, in_halves(1000));
  EXPECT_TRUE(cut_into_passes({32, 32}, {32, 32}, {0.5, 0.5}).empty());
  expect_whole(cut_into_passes({32, 0}, {32, 16}, {0.5, 0.5}), {32, 0}, {32, 16});
}

TEST(SamplePasses, AreLongEnoughForTheirFixedCostAndShortEnoughToLose) {
  for (const double fixed : {0.3, 2.0, 30.0}) {
    const PassCost cost{fixed, 0.05};
    for (const SamplePass& pass : cut_into_passes({0, 0}, in_halves(1 << 17), cost)) {
      const double seconds = pass.count * cost.sample_seconds, before = pass.first * cost.sample_seconds;
      EXPECT_GE(seconds, 20 * fixed);
      EXPECT_LE(seconds, 3 * std::max({20 * fixed, 10.0, before / 16}));
    }
  }
}

TEST(SamplePasses, OfALargeAtlasAreFew) {
  const PassCost large{1, 100};  // a sample takes longer than the shortest pass
  EXPECT_EQ(cut_into_passes({0, 0}, {4, 4}, large).size(), 8U);
  const auto passes = [&](int samples) { return cut_into_passes({0, 0}, {samples, samples}, large).size(); };
  EXPECT_EQ(passes(128), 2U * (16 + 8 + 8 + 8));
  EXPECT_EQ(passes(1024) - passes(512), passes(512) - passes(256));
}

TEST(SamplePasses, TakeTurns) {
  const std::vector<SamplePass> passes = cut_into_passes({0, 0}, {64, 64}, {0.3, 1});
  for (std::size_t i = 0; i < passes.size(); ++i) EXPECT_EQ(passes[i].half, int(i % 2));
}

TEST(SamplePasses, HaveSeedsOfTheirOwn) {
  EXPECT_EQ(seed_of_half(7, 0), 7);
  for (const int seed : {0, 1, 2, 100, 2147483647}) {
    EXPECT_GE(seed_of_half(seed, 1), 0);
    EXPECT_GT(std::abs(double(seed_of_half(seed, 1)) - seed), 1000);
  }
}

TEST(CutBatch, KeepsTargetsWholeAndInTheirOrder) {
  Plan plan;
  Batch all;
  for (std::size_t task = 0; task < 20; ++task) {  // five targets of four tasks, 100 pixels each
    plan.tasks.push_back({task / 4, "task", task % 4, {plan.rects.size()}, {}});
    plan.rects.push_back({task / 4, {}, 0, 0, {10, 10}});
    all.tasks.push_back(task);
  }
  const auto targets = [&](std::int64_t most_pixels) {
    std::vector<std::size_t> counts;
    std::vector<std::size_t> together;
    for (const Batch& batch : cut(all, plan, most_pixels)) {
      counts.push_back(batch.tasks.size() / 4);
      together.insert(together.end(), batch.tasks.begin(), batch.tasks.end());
    }
    EXPECT_EQ(together, all.tasks);
    return counts;
  };
  EXPECT_EQ(targets(2000), (std::vector<std::size_t>{5}));
  EXPECT_EQ(targets(1999), (std::vector<std::size_t>{4, 1}));
  EXPECT_EQ(targets(800), (std::vector<std::size_t>{2, 2, 1}));
  EXPECT_EQ(targets(10), (std::vector<std::size_t>{1, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace rnmbake
