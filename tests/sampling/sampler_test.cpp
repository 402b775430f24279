#include "sampling/sampler.h"

#include <array>
#include <cstddef>
#include <set>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A (0,2)-sequence: of 256 points each elementary interval of area 1/256 holds one, whatever its shape.
TEST(SamplerTest, EveryPairIsAZeroTwoSequence) {
  for (int dimension = 0; dimension < 3; ++dimension) {
    for (int columns = 1; columns <= 256; columns *= 2) {
      const int rows = 256 / columns;
      std::set<std::size_t> cells;
      for (std::uint32_t i = 0; i < 256; ++i) {
        Sampler sampler(11, i);
        Vec2 point = sampler.next2();
        for (int skip = 0; skip < dimension; ++skip) point = sampler.next2();
        cells.insert(std::size_t(point.y * float(rows)) * columns + std::size_t(point.x * float(columns)));
      }
      EXPECT_EQ(cells.size(), 256) << columns << " columns, pair " << dimension;
    }
  }
}

TEST(SamplerTest, OtherSeedsAreOtherPoints) {
  EXPECT_NE(Sampler(1, 0).next2(), Sampler(2, 0).next2());
  EXPECT_EQ(Sampler(1, 5).next2(), Sampler(1, 5).next2());
}

}  // namespace
}  // namespace rnmbake
