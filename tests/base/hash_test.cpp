#include "base/hash.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Hash, IsXxh3) {
  EXPECT_EQ(hash64(""), 0x2D06800538D394C2u);  // the algorithm's published value for the empty input
  EXPECT_EQ(hash128_hex(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(short_hash("").size(), 8u);
  EXPECT_NE(short_hash("a"), short_hash("b"));
}

}  // namespace
}  // namespace rnmbake
