#include "lightmap/mask_pack.h"

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// '#' is a texel of the mask.
TexelBits drawn(const std::vector<std::string>& rows) {
  TexelBits mask(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()));
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x)
      if (rows[std::size_t(y)][std::size_t(x)] == '#') mask.set(x, y);
  }
  return mask;
}

TexelBits full(int width, int height) {
  return drawn(std::vector<std::string>(std::size_t(height), std::string(std::size_t(width), '#')));
}

/// Frames, strips and what else charts look like, with texels at random left out.
std::vector<TexelBits> random_masks(unsigned seed, int count, int largest) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> side(1, largest), kind(0, 3), share(0, 9);
  std::vector<TexelBits> masks;
  for (int i = 0; i < count; ++i) {
    TexelBits mask(side(random), side(random));
    const int shape = kind(random), left_out = share(random);
    for (int y = 0; y < mask.height(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        const bool border = x < 2 || y < 2 || x >= mask.width() - 2 || y >= mask.height() - 2;
        const bool in = shape == 0 || (shape == 1 && border) || (shape == 2 && x / 3 % 3 == 0) ||
                        (shape == 3 && share(random) >= left_out);
        if (in) mask.set(x, y);
      }
    }
    masks.push_back(std::move(mask));
  }
  return masks;
}

/// Paints every mask into its page: nothing outside, nothing twice.
void expect_sound(const std::vector<TexelBits>& masks, const MaskPlan& plan, int side) {
  ASSERT_EQ(plan.places.size(), masks.size());
  std::vector<TexelBits> taken;
  for (const MaskPlan::Page& page : plan.pages) {
    ASSERT_TRUE(page.width <= side && page.height <= side);
    ASSERT_TRUE(page.width % 4 == 0 && page.height % 4 == 0) << page.width << " x " << page.height;
    taken.emplace_back(page.width, page.height);
  }
  std::vector<std::size_t> members(plan.pages.size());
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const MaskPlan::Place& place = plan.places[i];
    ASSERT_LT(place.page, plan.pages.size());
    ++members[place.page];
    TexelBits& page = taken[place.page];
    ASSERT_TRUE(place.x >= 0 && place.y >= 0 && place.x + masks[i].width() <= page.width() &&
                place.y + masks[i].height() <= page.height());
    for (int y = 0; y < masks[i].height(); ++y) {
      for (int x = 0; x < masks[i].width(); ++x) {
        if (!masks[i].at(x, y)) continue;
        ASSERT_FALSE(page.at(place.x + x, place.y + y)) << "mask " << i << " at " << x << ", " << y;
        page.set(place.x + x, place.y + y);
      }
    }
  }
  for (const std::size_t count : members) EXPECT_GT(count, 0U);
}

double texels_of(const MaskPlan& plan) {
  double texels = 0;
  for (const MaskPlan::Page& page : plan.pages) texels += double(page.width) * page.height;
  return texels;
}

TEST(MaskPack, SharesNoTexelAndStaysOnThePage) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const auto masks = random_masks(seed, 1 + int(seed) * 2, 1 + int(seed * 7 % 60));
    for (const int side : {64, 100, 256}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " side " << side);
      expect_sound(masks, pack_masks(masks, side), side);
    }
  }
}

TEST(MaskPack, KeepsBordersApart) {
  for (const int border : {1, 2, 4}) {
    std::vector<TexelBits> masks;
    for (const TexelBits& mask : random_masks(3, 40, 30)) masks.push_back(grown(mask, border));
    expect_sound(masks, pack_masks(masks, 256), 256);
  }
}

TEST(MaskPack, InterlocksTwoElls) {
  const TexelBits ell = drawn({"##......", "##......", "##......", "##......", "##......", "########"});
  const TexelBits turned = drawn({"########", "......##", "......##", "......##", "......##", "......##"});
  const MaskPlan plan = pack_masks({ell, turned}, 64);
  expect_sound({ell, turned}, plan, 64);
  EXPECT_LE(texels_of(plan), 8 * 12);  // side by side: 16 x 8
  const TexelBits large = drawn({"####........", "####........", "####........", "####........",
                                 "############", "############", "############", "############"});
  const TexelBits small = full(8, 4);
  const MaskPlan nested = pack_masks({large, small}, 64);
  expect_sound({large, small}, nested, 64);
  EXPECT_EQ(texels_of(nested), 12 * 8);  // not a texel lost
}

TEST(MaskPack, FillsFrames) {
  TexelBits frame(64, 64);
  for (int i = 0; i < 64; ++i) {
    for (const int edge : {0, 63}) {
      frame.set(i, edge);
      frame.set(edge, i);
    }
  }
  std::vector<TexelBits> masks(4, full(31, 31));
  masks.push_back(frame);
  const MaskPlan plan = pack_masks(masks, 256);
  expect_sound(masks, plan, 256);
  EXPECT_EQ(texels_of(plan), 64 * 64);
}

TEST(MaskPack, MakesFullPagesWhereOneIsTooSmall) {
  const std::vector<TexelBits> masks(9, full(32, 32));
  const MaskPlan plan = pack_masks(masks, 64);
  expect_sound(masks, plan, 64);
  ASSERT_EQ(plan.pages.size(), 3U);
  EXPECT_EQ(texels_of(plan), 9 * 32 * 32);
}

TEST(MaskPack, IsFilledAndAboutSquare) {
  const std::vector<TexelBits> masks(12, full(50, 50));
  const MaskPlan plan = pack_masks(masks, 4096);
  ASSERT_EQ(plan.pages.size(), 1U);
  const auto [shorter, longer] = std::minmax(plan.pages[0].width, plan.pages[0].height);
  EXPECT_LE(texels_of(plan), 1.15 * 12 * 50 * 50);
  EXPECT_LE(longer, 2 * shorter);
}

TEST(MaskPack, IsTheSameEveryTime) {
  const auto masks = random_masks(9, 80, 40);
  const MaskPlan a = pack_masks(masks, 128), b = pack_masks(masks, 128);
  ASSERT_EQ(a.pages.size(), b.pages.size());
  for (std::size_t i = 0; i < masks.size(); ++i) {
    EXPECT_EQ(a.places[i].page, b.places[i].page);
    EXPECT_EQ(a.places[i].x, b.places[i].x);
    EXPECT_EQ(a.places[i].y, b.places[i].y);
  }
}

TEST(MaskPack, TakesMasksWithoutTexelsAndNoMasks) {
  EXPECT_TRUE(pack_masks({}, 64).pages.empty());
  const std::vector<TexelBits> masks{TexelBits(5, 5), full(3, 3)};
  expect_sound(masks, pack_masks(masks, 64), 64);
}

TEST(MaskPack, RefusesWhatIsLarger) {
  EXPECT_THROW((void)pack_masks({full(65, 3)}, 64), std::invalid_argument);
  EXPECT_THROW((void)pack_masks({full(3, 65)}, 64), std::invalid_argument);
}

}  // namespace
}  // namespace rnmbake
