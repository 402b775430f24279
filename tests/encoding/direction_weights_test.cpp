#include "encoding/fit/direction_weights.h"

#include "encoding/direction_sets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::vector<Vec3> axes_of(const BasisSet& set) {
  std::vector<Vec3> axes;
  for (const BasisDirection& basis : set.directions) axes.push_back(basis.direction);
  return axes;
}

/// Evenly over the upper hemisphere: Fibonacci's spiral.
std::vector<Vec3> spiral(int count) {
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i)
    directions.emplace_back(direction_at(std::acos((i + 0.5) / count), pi * (3 - std::sqrt(5.0)) * i));
  return directions;
}

std::vector<float> cosines(const std::vector<Vec3>& directions, const Vec3& normal) {
  std::vector<float> values;
  for (const Vec3& direction : directions) values.push_back(std::max(0.0F, direction.dot(normal)));
  return values;
}

/// A sky that is closed on one side, seen by a normal that leans to the open one.
std::vector<float> beside_wall(const std::vector<Vec3>& directions) {
  std::vector<float> values = cosines(directions, Vec3(-0.3F, 0.1F, 1).normalized());
  for (std::size_t k = 0; k < values.size(); ++k)
    if (directions[k].x > 0.2F) values[k] = 0;
  return values;
}

std::vector<float> solved(const DirectionWeights& weights, const std::vector<float>& response,
                          WeightSign sign) {
  std::vector<float> found(weights.count());
  weights.solve(response, sign, found);
  return found;
}

/// sum of s_i f_i in each direction.
std::vector<double> light_of(const std::vector<float>& weights, const std::vector<Vec3>& axes,
                             const std::vector<Vec3>& directions) {
  std::vector<double> light;
  for (const Vec3& direction : directions) {
    double sum = 0;
    for (std::size_t i = 0; i < axes.size(); ++i)
      sum += double{weights[i] * std::max(0.0F, direction.dot(axes[i]))};
    light.push_back(sum);
  }
  return light;
}

double squared_error(const std::vector<double>& light, const std::vector<float>& response) {
  double sum = 0;
  for (std::size_t k = 0; k < light.size(); ++k) sum += std::pow(light[k] - double{response[k]}, 2);
  return sum;
}

constexpr std::array signs{WeightSign::free, WeightSign::positive};

TEST(DirectionWeights, AnOpenFlatTexelIsTheFlatLightmapAlone) {
  const auto directions = spiral(300);
  for (const char* name : {"l1", "h6", "sh3"}) {
    const BasisSet set = *direction_set(name);
    const DirectionWeights weights(axes_of(set), directions);
    for (const WeightSign sign : signs) {
      const auto s = solved(weights, cosines(directions, Vec3(0, 0, 1)), sign);
      for (std::size_t i = 0; i < s.size(); ++i)
        EXPECT_NEAR(s[i], set.directions[i].name == "flat" ? 1 : 0, 1e-4) << name << " " << i;
    }
  }
}

TEST(DirectionWeights, ThreeAxesInTheOpenAreAThirdOfTheFlatBakeOverTheirLight) {
  const DirectionWeights weights(axes_of(rnm_set()), spiral(60000));
  // Lightmaps of a uniform sky hold (1 + 1/sqrt 3) / 2 each, of which a third each is 0.789.
  const double expected = 1.0 / 3 / ((1 + std::sqrt(1.0 / 3)) / 2);
  for (const WeightSign sign : signs)
    for (const float s : solved(weights, cosines(spiral(60000), Vec3(0, 0, 1)), sign))
      EXPECT_NEAR(s, expected, 1e-3);
}

TEST(DirectionWeights, AnEvenSkyIsExactForAnySet) {
  const auto directions = spiral(500);
  const auto response = beside_wall(directions);
  const double truth = std::accumulate(response.begin(), response.end(), 0.0);
  for (const BasisSet& set : {rnm_set(), flat_and_rnm(), *direction_set("h6"), *direction_set("sh3")}) {
    const auto axes = axes_of(set);
    for (const WeightSign sign : signs) {
      const auto light = light_of(solved({axes, directions}, response, sign), axes, directions);
      EXPECT_NEAR(std::accumulate(light.begin(), light.end(), 0.0), truth, 1e-4 * truth) << set.name;
    }
  }
}

TEST(DirectionWeights, NoOtherWeightsOfTheSameSkyComeNearer) {
  const auto directions = spiral(500);
  const auto response = beside_wall(directions);
  const auto axes = axes_of(*direction_set("h6"));
  const DirectionWeights weights(axes, directions);
  const auto s = solved(weights, response, WeightSign::free);
  const double least = squared_error(light_of(s, axes, directions), response);
  std::vector<double> whole;
  for (const Vec3& axis : axes) {
    const auto lobe = cosines(directions, axis);
    whole.push_back(std::accumulate(lobe.begin(), lobe.end(), 0.0));
  }
  std::mt19937 random(3);
  std::uniform_int_distribution<std::size_t> any(0, axes.size() - 1);
  for (int i = 0; i < 100; ++i) {
    const std::size_t up = any(random), down = any(random);
    if (up == down) continue;
    auto other = s;
    other[up] += 0.01F;
    other[down] -= static_cast<float>(0.01 * whole[up] / whole[down]);
    EXPECT_GT(squared_error(light_of(other, axes, directions), response), least);
  }
}

TEST(DirectionWeights, MoreDirectionsComeNearerAndPositiveOnesLess) {
  const auto directions = spiral(500);
  const auto response = beside_wall(directions);
  double before = 1e9;
  for (const BasisSet& set :
       {rnm_set(), flat_and_rnm(), *direction_set("l1"), *direction_set("h6"), *direction_set("sh3")}) {
    const auto axes = axes_of(set);
    const DirectionWeights weights(axes, directions);
    const auto free = solved(weights, response, WeightSign::free),
               positive = solved(weights, response, WeightSign::positive);
    const double error = squared_error(light_of(free, axes, directions), response);
    EXPECT_LT(error, before) << set.name;
    EXPECT_LE(error, squared_error(light_of(positive, axes, directions), response) + 1e-6) << set.name;
    EXPECT_GE(std::ranges::min(positive), 0) << set.name;
    before = error;
  }
}

TEST(DirectionWeights, AxesThatAreAlikeShare) {
  const auto directions = spiral(300);
  auto axes = axes_of(flat_and_rnm());
  axes.emplace_back(0, 0, 1);
  const auto s = solved({axes, directions}, cosines(directions, Vec3(0, 0, 1)), WeightSign::free);
  EXPECT_NEAR(s[0], 0.5, 1e-4);
  EXPECT_NEAR(s[4], 0.5, 1e-4);
}

TEST(DirectionWeights, AClosedSkyIsDark) {
  const auto directions = spiral(300);
  const DirectionWeights weights(axes_of(*direction_set("h6")), directions);
  for (const WeightSign sign : signs)
    for (const float s : solved(weights, std::vector<float>(300), sign)) EXPECT_EQ(s, 0);
}

}  // namespace
}  // namespace rnmbake
