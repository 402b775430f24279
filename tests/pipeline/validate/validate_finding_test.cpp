#include "pipeline/validate/validate_finding.h"

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
  EXPECT_TRUE(said.ends_with("; 1 of 2 objects is too noisy to tell, bake with more samples")) << said;
}

TEST(ValidateFinding, NamesTheWorstObject) {
  const std::string said = receiver_finding(
      report({object("a", statistic(0.02, 0.001)), object("b", statistic(-0.5, 0.1)), object("c", {})}));
  EXPECT_EQ(said, "receiver: 2 of 3 objects have a bias beyond the noise, most of all b (-50.0 %)");
}

TEST(ValidateFinding, WhatTheReferenceDoesNotFollowIsNoBias) {
  Report of = report({object("a", statistic(-0.819, 0.001)), object("b", {})});
  of.not_followed = {"light 'Lamp': node tree", "world: volume"};
  EXPECT_EQ(
      receiver_finding(of),
      "receiver: not followed by the reference: light 'Lamp': node tree and 1 more; 1 of 2 objects differs "
      "beyond the noise, most of all a (-81.9 %)");
  Report fine = report({object("a", {})});
  fine.not_followed = of.not_followed;
  EXPECT_EQ(receiver_finding(fine).rfind("receiver: no bias beyond the noise", 0), 0U);

  const BasisDecomposition rnm{"rnm0", 1, {row("noise", 0), row("residual", -0.8)}, row("total", -0.8)};
  EXPECT_NE(recipe_finding({"scene", {rnm}}, of.not_followed).find("; not followed by the reference -80.0 %"),
            std::string::npos);
  EXPECT_NE(recipe_finding({"scene", {rnm}}, {}).find("; unexplained -80.0 %"), std::string::npos);
}

TEST(ValidateFinding, SaysWhatTheLimitOfBouncesCosts) {
  Report of = report({object("a", {})});
  of.bounce_limit = {32, statistic(-0.064, 0.001)};
  EXPECT_NE(receiver_finding(of).find("; the bounce limit of 32 costs -6.4 %"), std::string::npos);
  of.bounce_limit = {32, statistic(-0.0004, 0.001)};
  EXPECT_EQ(receiver_finding(of).find("bounce"), std::string::npos);
}

TEST(ValidateFinding, TellsTheCausesByTheirSize) {
  BasisDecomposition flat{"flat", 1, {row("bump shadowing", 0.9)}, row("total", 0.9)};
  BasisDecomposition rnm{"rnm0",
                         1,
                         {row("tilt clamp", 0.02), row("bump shadowing", -0.13),
                          row("light from below", 0.0004), row("noise", 0), row("residual", 0.0005)},
                         row("total", -0.11)};
  const std::string said = recipe_finding({"scene", {flat, rnm}}, {});
  EXPECT_EQ(said.rfind("flat-normal-map: -11.0 % on average, from bump shadowing -13.0 %, tilt clamp +2.0 %; "
                       "unexplained ",
                       0),
            0U)
      << said;
}

}  // namespace
}  // namespace rnmbake
