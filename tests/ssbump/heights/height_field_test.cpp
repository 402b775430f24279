#include "ssbump/heights/height_field.h"

#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::vector<int> texels(int from, int to, int size, WrapMode beyond) {
  std::vector<int> found;
  for (int i = from; i <= to; ++i) found.push_back(texel_beyond(i, size, beyond));
  return found;
}

TEST(HeightField, GoesOnBeyondItsBordersOnBothSides) {
  EXPECT_EQ(texels(-4, 6, 3, WrapMode::wrap), (std::vector{2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0}));
  EXPECT_EQ(texels(-4, 6, 3, WrapMode::mirror), (std::vector{2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0}));
  EXPECT_EQ(texels(-4, 6, 3, WrapMode::none), (std::vector{0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2}));
}

TEST(HeightField, OfOneTexelIsThatTexelEverywhere) {
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none})
    EXPECT_EQ(texels(-3, 3, 1, beyond), std::vector<int>(7, 0));
}

}  // namespace
}  // namespace rnmbake
