#include "report/thresholds.h"

#include "base/error.h"
#include "report/fixture.h"

#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Thresholds, AreShares) {
  const auto thresholds = parse_thresholds("rmse=2%,bias=0.5%,max=0.1");
  ASSERT_EQ(thresholds.size(), 3U);
  EXPECT_EQ(thresholds[0].metric, "rmse");
  EXPECT_DOUBLE_EQ(thresholds[0].limit, 0.02);
  EXPECT_TRUE(thresholds[0].relative);
  EXPECT_DOUBLE_EQ(thresholds[1].limit, 0.005);
  EXPECT_DOUBLE_EQ(thresholds[2].limit, 0.1);
  EXPECT_FALSE(thresholds[2].relative);
}

TEST(Thresholds, RefuseWhatDoesNotFit) {
  for (const char* text : {"", "rmse", "rmse=", "rmse=%", "rmse=2%%", "rsme=2%", "rmse=-1", "rmse=two",
                           "rmse=nan", "rmse=1,,bias=1"}) {
    try {
      static_cast<void>(parse_thresholds(text));
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage) << text;
    }
  }
}

TEST(Thresholds, GuessWhatWasMeant) {
  try {
    static_cast<void>(parse_thresholds("rsme=2%"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'rmse'?"), std::string::npos) << error.what();
  }
}

ThresholdOutcome check(const std::string& text, double bias, double rmse) {
  return check_thresholds(report_of({{"floor", {basis_of("flat", bias, rmse)}}}), parse_thresholds(text));
}

TEST(Thresholds, EachMetricIsHeldAgainstItsLimit) {
  EXPECT_TRUE(check("rmse=3%,bias=1%,p95=0.2,p99=20%,max=50%", 0.01, 0.03).exceeded.empty());
  EXPECT_EQ(check("rmse=2.9%", 0, 0.03).exceeded.size(), 1U);
  EXPECT_EQ(check("rmse=0.05", 0, 0.03).exceeded.size(), 1U);   // 0.06 in E/pi
  EXPECT_EQ(check("bias=0.9%", -0.01, 0).exceeded.size(), 1U);  // its size counts
  EXPECT_EQ(check("p95=0.19", 0, 0).exceeded.size(), 1U);
  EXPECT_EQ(check("p99=19%", 0, 0).exceeded.size(), 1U);
  EXPECT_EQ(check("max=49%", 0, 0).exceeded.size(), 1U);
}

TEST(Thresholds, WhatCannotBeToldIsAboveTheLimit) {
  EXPECT_EQ(check("rmse=100%", 0, std::numeric_limits<double>::quiet_NaN()).exceeded.size(), 1U);
  EXPECT_EQ(check("rmse=100%", 0, std::numeric_limits<double>::infinity()).exceeded.size(), 1U);
}

TEST(Thresholds, OneLineForEachObjectWithItsWorstBasis) {
  const Report report = report_of({{"floor", {basis_of("flat", 0, 0.03), basis_of("rnm1", 0.02, 0.04)}},
                                   {"wall", {basis_of("flat", 0, 0.001)}},
                                   {"roof", {basis_of("flat", 0, 0.5)}}});
  const auto lines = describe(check_thresholds(report, parse_thresholds("rmse=2%,bias=1%")));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "floor: rmse 4.00 % in rnm1 is above 2.00 %; bias 2.00 % in rnm1 is above 1.00 %");
  EXPECT_EQ(lines[1], "roof: rmse 50.0 % in flat is above 2.00 %");
}

}  // namespace
}  // namespace rnmbake
