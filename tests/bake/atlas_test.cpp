#include "bake/atlas.h"

#include <algorithm>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::vector<RectSize> random_tiles(unsigned seed, int count, int largest) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> side(1, largest);
  std::vector<RectSize> rects;
  rects.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i) rects.push_back({side(random), side(random)});
  return rects;
}

/// Paints every tile into its atlas: nothing outside, nothing twice.
void expect_sound(const std::vector<RectSize>& rects, const AtlasPlan& plan, std::int64_t max_pixels) {
  ASSERT_EQ(plan.placements.size(), rects.size());
  std::vector<std::vector<char>> used;
  for (const RectSize& atlas : plan.atlases) used.emplace_back(std::size_t(atlas.width) * atlas.height);
  std::vector<std::size_t> members(plan.atlases.size());
  for (std::size_t i = 0; i < rects.size(); ++i) {
    const Placement& place = plan.placements[i];
    ASSERT_LT(place.atlas, plan.atlases.size());
    const RectSize& atlas = plan.atlases[place.atlas];
    ++members[place.atlas];
    ASSERT_TRUE(place.x >= 0 && place.y >= 0 && place.x + rects[i].width <= atlas.width &&
                place.y + rects[i].height <= atlas.height);
    for (int y = place.y; y < place.y + rects[i].height; ++y) {
      for (int x = place.x; x < place.x + rects[i].width; ++x)
        ASSERT_EQ(used[place.atlas][std::size_t(y) * atlas.width + x]++, 0);
    }
  }
  for (std::size_t a = 0; a < plan.atlases.size(); ++a) {
    ASSERT_GT(members[a], 0U);
    const auto pixels = std::int64_t(plan.atlases[a].width) * plan.atlases[a].height;
    if (members[a] > 1) {
      ASSERT_LE(pixels, max_pixels);
    }
  }
}

TEST(Atlas, HasNoOverlapsAndKeepsTheLimit) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const auto rects = random_tiles(seed, 1 + int(seed) * 3, 1 + int(seed * 7 % 64));
    for (const std::int64_t limit : {1, 100, 999, 4096, 70000, 1 << 24}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " limit " << limit);
      expect_sound(rects, pack(rects, limit), limit);
    }
  }
}

TEST(Atlas, OfTilesAsLargeAsTheLimitHasOneEach) {
  const std::vector<RectSize> rects{{2048, 2048}, {1024, 1024}, {1024, 1024}};
  const AtlasPlan plan = pack(rects, 1 << 20);
  EXPECT_EQ(plan.atlases.size(), 3U);
}

TEST(Atlas, ThatIsTallDoesNotTakeNeighboursBeyondTheLimit) {
  const std::vector<RectSize> rects{{4, 20}, {4, 4}, {4, 4}};
  expect_sound(rects, pack(rects, 100), 100);
}

TEST(Atlas, OfOneTileHasItsSize) {
  const AtlasPlan plan = pack({{37, 5}}, 1 << 24);
  ASSERT_EQ(plan.atlases.size(), 1U);
  EXPECT_EQ(plan.atlases[0].width, 37);
  EXPECT_EQ(plan.atlases[0].height, 5);
}

TEST(Atlas, OfOneTileBeyondTheLimitHasItsSize) {
  const AtlasPlan plan = pack({{64, 64}}, 100);
  ASSERT_EQ(plan.atlases.size(), 1U);
  EXPECT_EQ(plan.atlases[0].width * plan.atlases[0].height, 64 * 64);
}

TEST(Atlas, OfEqualSquaresIsFull) {
  const AtlasPlan plan = pack(std::vector<RectSize>(64, RectSize{64, 64}), 1 << 24);
  ASSERT_EQ(plan.atlases.size(), 1U);
  EXPECT_EQ(plan.atlases[0].width * plan.atlases[0].height, 64 * 64 * 64);
}

TEST(Atlas, FillsTheRoomBesideWhatIsTall) {
  std::vector<RectSize> rects(48, RectSize{16, 16});
  rects.push_back({64, 64});  // all of them are a square of 128 x 128, of which a shelf leaves 48 x 64 empty
  const AtlasPlan plan = pack(rects, 1 << 24);
  ASSERT_EQ(plan.atlases.size(), 1U);
  EXPECT_EQ(plan.atlases[0].width * plan.atlases[0].height, 128 * 128);
}

TEST(Atlas, OfWhatIsTallerThanTheLimitIsWideIsFull) {
  const std::vector<RectSize> rects(64, RectSize{64, 2000});
  const AtlasPlan plan = pack(rects, 1 << 20);
  expect_sound(rects, plan, 1 << 20);
  EXPECT_EQ(plan.atlases.size(), 8U);
}

TEST(Atlas, OfEqualRectanglesKeepsTheirOrder) {
  const AtlasPlan plan = pack(std::vector<RectSize>(1000, RectSize{8, 8}), 1 << 24);
  for (std::size_t i = 1; i < 1000; ++i) {
    const auto &before = plan.placements[i - 1], &here = plan.placements[i];
    EXPECT_LT(std::pair(before.y, before.x), std::pair(here.y, here.x));
  }
}

TEST(Atlas, WastesLittleOnMixedSizes) {
  const auto rects = random_tiles(5, 500, 64);
  std::int64_t wanted = 0, used = 0;
  for (const RectSize& rect : rects) wanted += std::int64_t(rect.width) * rect.height;
  for (const RectSize& atlas : pack(rects, 1 << 24).atlases) used += std::int64_t(atlas.width) * atlas.height;
  EXPECT_LT(double(used), 1.07 * double(wanted));  // what shelves take of these
}

TEST(Atlas, IsTheSameEveryTime) {
  const auto rects = random_tiles(9, 200, 40);
  const AtlasPlan a = pack(rects, 20000), b = pack(rects, 20000);
  ASSERT_EQ(a.atlases.size(), b.atlases.size());
  for (std::size_t i = 0; i < rects.size(); ++i) {
    EXPECT_EQ(a.placements[i].atlas, b.placements[i].atlas);
    EXPECT_EQ(a.placements[i].x, b.placements[i].x);
    EXPECT_EQ(a.placements[i].y, b.placements[i].y);
  }
}

TEST(Atlas, OfNothingIsNothing) {
  EXPECT_TRUE(pack({}, 100).atlases.empty());
}

}  // namespace
}  // namespace rnmbake
