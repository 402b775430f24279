#include "encoding/geomerics.h"
#include "encoding/random_light.h"
#include "encoding/refit/flat_kept.h"
#include "encoding/refit/newton_lanes.h"
#include "encoding/refit/refit.h"
#include "encoding/sh2.h"
#include "encoding/zh3.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace rnmbake {
namespace {

/// Runs `work` with each set of instructions of this machine, then puts the best one back.
void with_each_instruction_set(const std::function<void(const char* name)>& work) {
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    work(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Bakes of random lights, one in ten dark, one in ten such that no numbers return them.
std::vector<FourBakes> some_bakes(std::size_t count) {
  std::mt19937 random(11);
  std::vector<FourBakes> bakes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Hemisphere light = random_hemisphere(random);
    for (std::size_t k = 0; k < 4; ++k) bakes[i][k] = irradiance(light, four_directions()[k]);
    if (i % 10 == 3) bakes[i] = {};
    if (i % 10 == 7) bakes[i] = {0.05, 1, 1, 1};
  }
  return bakes;
}

double distance(const FourNumbers& a, const FourNumbers& b) {
  return std::max(std::abs(a.a - b.a), (a.v - b.v).length());
}

TEST(Lanes, RefitAsOneAfterTheOther) {
  const std::vector<FourBakes> bakes = some_bakes(203);  // no multiple of a vector
  for (const Lobe lobe : {Lobe(zh3_lobe), Lobe(geomerics_lobe)}) {
    with_each_instruction_set([&](const char* name) {
      std::vector<FourNumbers> numbers(bakes.size());
      refit(lobe, bakes, numbers);
      for (std::size_t i = 0; i < bakes.size(); ++i) {
        const FourNumbers alone = refit(lobe, bakes[i]);
        EXPECT_EQ(numbers[i].has_converged, alone.has_converged) << name << ' ' << i;
        EXPECT_LE(distance(numbers[i], alone), 1e-6 * *std::ranges::max_element(bakes[i]))
            << name << ' ' << i;
      }
    });
  }
}

TEST(Lanes, ReturnTheBakesByTheScalarLobe) {
  // The formula of lanes and that of one number are one; this holds for their exponentials too.
  const std::vector<FourBakes> all = some_bakes(400);
  for (const Lobe lobe : {Lobe(zh3_lobe), Lobe(geomerics_lobe)}) {
    with_each_instruction_set([&](const char* name) {
      std::vector<FourBakes> scaled;
      std::vector<FourNumbers> numbers;
      for (FourBakes bakes : all) {
        const double greatest = *std::ranges::max_element(bakes);
        if (greatest == 0) continue;
        for (double& bake : bakes) bake /= greatest;
        scaled.push_back(bakes);
        numbers.push_back(linear_numbers(bakes));
      }
      newton_in_lanes(lobe, four_directions(), scaled, numbers);
      std::size_t arrived = 0;
      for (std::size_t i = 0; i < scaled.size(); ++i) {
        if (!numbers[i].has_converged) continue;
        ++arrived;
        for (std::size_t k = 0; k < 4; ++k) {
          // The root of what may be left, and the last place of an exponential.
          EXPECT_NEAR(lobe(numbers[i].a, numbers[i].v, four_directions()[k]).value, scaled[i][k], 1.1e-8)
              << name << ' ' << i;
        }
      }
      EXPECT_GT(arrived, scaled.size() / 2) << name;
    });
  }
}

TEST(Lanes, DoNotDependOnTheirNeighbours) {
  const std::vector<FourBakes> bakes = some_bakes(64);
  for (const Lobe lobe : {Lobe(sh2_lobe), Lobe(zh3_lobe), Lobe(geomerics_lobe)}) {
    with_each_instruction_set([&](const char* name) {
      std::vector<FlatKeptProblem> problems;
      for (const FourBakes& one : bakes)
        if (one[0] > 0) problems.push_back({one, four_directions(), linear_numbers(one).v});
      std::vector<FourNumbers> numbers(bakes.size());
      if (lobe != sh2_lobe) refit(lobe, bakes, numbers);
      const std::vector<Vec3d> kept = flat_kept(lobe, problems, 2);
      for (std::size_t first = 0; first < 5; ++first) {
        const auto some = std::span(bakes).subspan(first);
        std::vector<FourNumbers> others(some.size());
        if (lobe != sh2_lobe) refit(lobe, some, others);
        for (std::size_t i = 0; i < some.size(); ++i)
          EXPECT_EQ(distance(others[i], numbers[first + i]), 0) << name << ' ' << i;
        const std::vector<Vec3d> again = flat_kept(lobe, std::span(problems).subspan(first), 2);
        for (std::size_t i = 0; i < again.size(); ++i)
          EXPECT_EQ(again[i], kept[first + i]) << name << ' ' << i;
      }
    });
  }
}

TEST(Lanes, LeastSquaresAreTheSameByEachSet) {
  for (const Lobe lobe : {Lobe(sh2_lobe), Lobe(zh3_lobe), Lobe(geomerics_lobe)}) {
    std::vector<FlatKeptProblem> problems;
    for (const FourBakes& one : some_bakes(100))
      if (one[0] > 0) problems.push_back({one, four_directions(), linear_numbers(one).v});
    const auto missed = [&](const FlatKeptProblem& problem, const Vec3d& ratio) {
      const double a = problem.bakes[0] / lobe(1, ratio, problem.directions[0]).value;
      double sum = 0;
      for (std::size_t k = 1; k < 4; ++k) {
        const double error = a * lobe(1, ratio, problem.directions[k]).value - problem.bakes[k];
        sum += error * error;
      }
      return std::sqrt(sum) / *std::ranges::max_element(problem.bakes);
    };
    std::vector<Vec3d> first;
    with_each_instruction_set([&](const char* name) {
      const std::vector<Vec3d> kept = flat_kept(lobe, problems, 2);
      if (first.empty()) first = kept;
      // As near as a refit is held to return the bakes.
      for (std::size_t i = 0; i < kept.size(); ++i)
        EXPECT_NEAR(missed(problems[i], kept[i]), missed(problems[i], first[i]), 1e-6) << name << ' ' << i;
    });
  }
}

}  // namespace
}  // namespace rnmbake
