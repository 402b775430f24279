// Plain objects show as what they stand for, by all rays and lights: scenes/stand_in_cases.py.
#include "survey_session.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(StandInsWithBlender, LookAsWhatTheyStandFor) {
  SurveySession session;
  EXPECT_NO_THROW(session.build("stand_in_cases.py", {}));
}

}  // namespace
}  // namespace rnmbake
