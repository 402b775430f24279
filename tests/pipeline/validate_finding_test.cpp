#include "pipeline/validate_finding.h"

#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

Statistic statistic(double value, double half_width) {
  return {value, value - half_width, value + half_width};
}

ObjectComparison object(const std::string& key, const Statistic& relative_bias) {
  ObjectComparison comparison;
  comparison.key = key;
  comparison.bases.push_back({"rnm0", {}});
  comparison.bases.back().metrics.relative_bias = relative_bias;
  return comparison;
}

Report report(const std::vector<ObjectComparison>& objects) {
  Report result;
  result.objects = objects;
  result.scene = objects.front().bases;
  return result;
}

DecompositionRow row(const std::string& name, double relative_bias) {
  return {name, {}, {}, statistic(relative_bias, 0.001), {}};
}

TEST(ValidateFinding, NoiseIsNoBias) {
  const std::string said = receiver_finding(report({object("a", statistic(0.02, 0.015)), object("b", {})}));
  EXPECT_EQ(said.rfind("receiver: no bias beyond the noise", 0), 0U) << said;
}

TEST(ValidateFinding, WhatIsTooNoisyToTellIsNoBiasAndIsCounted) {
  ObjectComparison noisy = object("a", statistic(-0.2, 0.01));
  noisy.bases.front().metrics.too_noisy = true;
  const std::string said = receiver_finding(report({object("b", statistic(0, 0.001)), noisy}));
  EXPECT_EQ(said.rfind("receiver: no bias beyond the noise", 0), 0U) << said;
  EXPECT_TRUE(said.ends_with("; 1 of 2 objects are too noisy to tell, bake with more samples")) << said;
}

TEST(ValidateFinding, NamesTheWorstObject) {
  const std::string said = receiver_finding(
      report({object("a", statistic(0.02, 0.001)), object("b", statistic(-0.5, 0.1)), object("c", {})}));
  EXPECT_EQ(said, "receiver: 2 of 3 objects have a bias beyond the noise, most of all b (-50.0 %)");
}

TEST(ValidateFinding, TellsTheCausesByTheirSize) {
  BasisDecomposition flat{"flat", 1, {row("bump shadowing", 0.9)}, row("total", 0.9)};
  BasisDecomposition rnm{"rnm0",
                         1,
                         {row("tilt clamp", 0.02), row("bump shadowing", -0.13),
                          row("light from below", 0.0004), row("noise", 0), row("residual", 0.0005)},
                         row("total", -0.11)};
  const std::string said = recipe_finding({"scene", {flat, rnm}});
  EXPECT_EQ(said.rfind("flat-normal-map: -11.0 % on average, from bump shadowing -13.0 %, tilt clamp +2.0 %; "
                       "unexplained ",
                       0),
            0U)
      << said;
}

}  // namespace
}  // namespace rnmbake
