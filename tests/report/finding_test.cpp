#include "report/finding.h"

#include "report/fixture.h"

#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Finding, NumbersHaveThreeDigits) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(1234.5), "1234");
  EXPECT_EQ(number(12.345), "12.3");
  EXPECT_EQ(number(0.012345), "0.0123");
  EXPECT_EQ(number(-0.5), "-0.500");
  EXPECT_EQ(number(1.5e-9), "1.50e-09");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "unknown");
}

TEST(Finding, SharesArePercent) {
  EXPECT_EQ(percent(0.0123), "1.23 %");
  EXPECT_EQ(percent(0.5), "50.0 %");
  EXPECT_EQ(percent(0.00012), "0.012 %");
  EXPECT_EQ(percent({0.01, -0.02, 0.04}, true), "+1.00 % (-2.00 to +4.00)");
  EXPECT_EQ(percent({0.01, 0.005, 0.04}, false), "1.00 % (0.50 to 4.00)");
}

TEST(Finding, SaysWhatIsBrighterAndWhereItIsWorst) {
  const Report report = report_of({{"floor", {basis_of("flat", 0.01, 0.03), basis_of("rnm0", -0.02, 0.02)}},
                                   {"wall", {basis_of("flat", 0, 0.2)}}});
  EXPECT_EQ(
      finding_of(report),
      "Over 2 objects, A is darker than B, most of all in rnm0 by 2.00 % (1.90 to 2.10); the error is up to "
      "3.00 % (2.90 to 3.10) RMS, noise included; the worst object is wall with 20.0 % in flat.");
}

TEST(Finding, DoesNotCallChanceABias) {
  Report report = report_of({{"floor", {basis_of("flat", 0.0005, 0.03)}}});
  report.scene.front().metrics.candidate_noise_known = true;
  report.scene.front().metrics.reference_noise_known = true;
  EXPECT_EQ(
      finding_of(report),
      "Over 1 object, A shows no bias against B that could be told from chance, the largest being +0.050 % "
      "(-0.050 to +0.15) in flat; the error is up to 3.00 % (2.90 to 3.10) RMS with the noise taken out.");
}

TEST(Finding, OfNothing) {
  EXPECT_EQ(finding_of(Report{}), "There was nothing to compare.");
  const double infinite = std::numeric_limits<double>::infinity();
  const Report black = report_of({{"floor", {basis_of("flat", infinite, infinite)}}});
  EXPECT_NE(finding_of(black).find("black"), std::string::npos);
}

}  // namespace
}  // namespace rnmbake
