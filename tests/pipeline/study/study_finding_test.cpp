#include "pipeline/study/study_finding.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

EncodingErrors row(const char* label, std::size_t bakes, int bytes, std::array<double, 4> rms) {
  EncodingErrors errors;
  errors.label = label;
  errors.bakes = bakes;
  errors.bytes = bytes;
  errors.rms = rms;
  return errors;
}

const EncodingErrors rnm = row("rnm-vrad", 4, 18, {0.1, 0.2, 0.3, 0.4});

TEST(StudyFinding, NamesTheSmallestThatIsNearerAtEveryTilt) {
  const std::string words = rnm_finding(
      {rnm, row("large", 4, 18, {0.01, 0.01, 0.01, 0.01}), row("small", 4, 9, {0.05, 0.15, 0.2, 0.3})});
  EXPECT_NE(words.find("does not pay at any tilt"), std::string::npos) << words;
  EXPECT_NE(words.find("'small' takes 9 bytes instead of 18 and is off by 15.0 % instead of 20.0 % up to 45"),
            std::string::npos)
      << words;
}

TEST(StudyFinding, SaysUpToWhichTiltItPays) {
  const std::string words = rnm_finding({rnm, row("steep", 4, 9, {0.2, 0.25, 0.2, 0.2})});
  EXPECT_NE(words.find("pays up to 45 degrees of tilt"), std::string::npos) << words;
  EXPECT_NE(words.find("20.0 % instead of 30.0 % up to 60 degrees"), std::string::npos) << words;
}

TEST(StudyFinding, MoreBakesOrBytesAreNoAnswer) {
  const std::string words =
      rnm_finding({rnm, row("bakes", 7, 9, {0, 0, 0, 0}), row("bytes", 4, 24, {0, 0, 0, 0})});
  EXPECT_NE(words.find("nothing of 4 bakes and 18 bytes is nearer"), std::string::npos) << words;
}

TEST(StudyFinding, SaysNothingWithoutRnm) {
  EXPECT_EQ(rnm_finding({row("sh2", 4, 24, {0, 0, 0, 0})}), "");
}

}  // namespace
}  // namespace rnmbake
