#include "base/large_vector.h"

#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr std::size_t page = LargePages<int>::page;

template <typename T>
std::size_t past_a_page(const LargeVector<T>& vector) {
  return reinterpret_cast<std::uintptr_t>(vector.data()) % page;
}

TEST(LargeVector, LargeOnesBeginAtALargePage) {
  for (const std::size_t bytes : {page, page + 1, 5 * page / 2}) {
    const LargeVector<std::uint8_t> vector(bytes, 7);
    EXPECT_EQ(past_a_page(vector), 0U) << bytes;
    EXPECT_EQ(vector.back(), 7);
  }
  EXPECT_EQ(past_a_page(LargeVector<double>(page / sizeof(double))), 0U);
}

TEST(LargeVector, KeepsItsValuesWhileItGrows) {
  LargeVector<int> vector;
  const int count = static_cast<int>(3 * page / sizeof(int));  // from small to large on the way
  for (int i = 0; i < count; ++i) vector.push_back(i);
  for (int i = 0; i < count; ++i) ASSERT_EQ(vector[static_cast<std::size_t>(i)], i);
  vector.assign({1, 2, 3});
  EXPECT_EQ(vector, (LargeVector<int>{1, 2, 3}));
}

TEST(LargeVector, SmallOnesAreVectorsToo) {
  LargeVector<float> some{1, 2, 3};
  const LargeVector<float> copy = some;
  const LargeVector<float> moved = std::move(some);
  EXPECT_EQ(copy, moved);
  EXPECT_TRUE(LargeVector<float>().empty());
}

}  // namespace
}  // namespace rnmbake
