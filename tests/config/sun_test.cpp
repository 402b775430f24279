#include "config/sun.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Sun, IsThreeNumbers) {
  const auto sun = sun_of("-135,45.5,3e1");
  ASSERT_TRUE(sun);
  EXPECT_EQ(sun->azimuth, -135);
  EXPECT_EQ(sun->elevation, 45.5);
  EXPECT_EQ(sun->strength, 30);
}

TEST(Sun, AnythingElseIsNone) {
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,3,", "1,2,3 ", " 1,2,3", "1;2;3", "361,45,3",
                           "0,91,3", "0,45,0", "0,45,-1", "0,45,nan", "inf,45,3", "0,45,3,4"})
    EXPECT_FALSE(sun_of(text)) << text;
}

}  // namespace
}  // namespace rnmbake
