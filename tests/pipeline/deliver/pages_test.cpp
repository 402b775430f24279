#include "pipeline/deliver/pages.h"

#include "base/error.h"
#include "base/files.h"
#include "lightmap/metadata.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// `light(x, y)`: of a covered texel.
template <typename Light>
LightmapPlace write_map(const TempFolder& folder, const std::string& key, int width, int height,
                        const std::function<bool(int, int)>& is_covered, const Light& light) {
  LightmapMetadata metadata;
  metadata.bases = {flat_direction()};
  metadata.object = key;
  LayeredImage image;
  image.layers = {{"", {"R", "G", "B"}, {width, height, 3}}, {"coverage", {""}, {width, height, 1}}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_covered(x, y)) continue;
      set_vec3(image.layers[0].pixels, x, y, light(x, y));
      image.layers[1].pixels.texel(x, y)[0] = 1;
    }
  }
  write_metadata(metadata, image);
  const auto file = folder.path() / (key + ".exr");
  write_exr(file, image, Depth::half);
  return {key, {file}, {}};
}

/// Covered but for two rows on top and a column at the right; each texel holds its own place.
LightmapPlace write_places(const TempFolder& folder, const std::string& key, int width, int height) {
  return write_map(
      folder, key, width, height, [&](int x, int y) { return y >= 2 && x < width - 1; },
      [&](int x, int y) { return Vec3(float(x), float(y), float(key[0])); });
}

/// A square map of one light.
LightmapPlace write_even(const TempFolder& folder, const std::string& key, int side, float light,
                         const std::function<bool(int, int)>& is_covered) {
  return write_map(folder, key, side, side, is_covered, [&](int, int) { return Vec3(light); });
}

class Pages : public testing::Test {
 protected:
  LightmapFolder maps() {
    LightmapFolder found{folder_.path(), false, {}, {}, {}};
    for (const auto& [key, width, height] : {std::tuple{"a", 16, 16}, {"b", 8, 24}, {"c", 20, 10}})
      found.places.push_back(write_places(folder_, key, width, height));
    return found;
  }
  TempFolder folder_;
};

TEST_F(Pages, HoldEveryCoveredTexelWhereTheUvsLead) {
  const LightmapFolder folder = maps();
  const PageLayout layout = lay_out_pages(folder, {64, 2});
  ASSERT_EQ(layout.pages.size(), 1U);
  EXPECT_EQ(layout.covered, std::size_t(15 * 14 + 7 * 22 + 19 * 8));
  const Page composed = compose_page(folder, layout, 0, {""});
  ASSERT_EQ(composed.layers.size(), 1U);
  const RectSize page = layout.pages[0];
  EXPECT_GT(layout.texels_for_each_covered(), layout.least_for_each_covered());
  EXPECT_NEAR(layout.covered_share(0), 1 / layout.texels_for_each_covered(), 1e-12);
  for (const PagedMap& map : layout.maps) {
    const Imath::V2d scale = map.scale(page), offset = map.offset(page);
    for (int y = 2; y < map.map.height; ++y) {
      for (int x = 0; x < map.map.width - 1; ++x) {
        const double u = (x + 0.5) / map.map.width * scale.x + offset.x;
        const double v = (y + 0.5) / map.map.height * scale.y + offset.y;
        const int px = int(u * page.width), py = int(v * page.height);
        EXPECT_EQ(vec3_at(composed.layers[0].pixels, px, py), Vec3(float(x), float(y), float(map.key[0])));
        EXPECT_EQ(composed.coverage.texel(px, py)[0], 1);
      }
    }
  }
}

TEST_F(Pages, AreFilledAroundEachMap) {
  const LightmapFolder folder = maps();
  const PageLayout layout = lay_out_pages(folder, {64, 2});
  const Page composed = compose_page(folder, layout, 0, {""});
  for (const PagedMap& map : layout.maps) {
    for (int x = 0; x < map.box.width; ++x) {
      for (const int y : {0, 1, map.box.height - 2, map.box.height - 1})
        EXPECT_EQ(composed.layers[0].pixels.texel(map.x + x, map.y + y)[2], float(map.key[0]))
            << map.key << x << y;
    }
  }
}

/// A frame of `side` texels with a border of 2, of the first; a square that fits into it, of the second.
class Interlocked : public testing::Test {
 protected:
  static constexpr int side = 40, hole = 16;

  LightmapPlace write_frame() {
    return write_even(folder_, "frame", side, 1, [](int x, int y) {
      return std::min({x, y, side - 1 - x, side - 1 - y}) < 2;
    });
  }
  LightmapPlace write_square() {
    return write_even(folder_, "square", hole, 2, [](int, int) { return true; });
  }
  LightmapFolder both() { return {folder_.path(), false, {write_frame(), write_square()}, {}, {}}; }
  TempFolder folder_;
};

TEST_F(Interlocked, LieInEachOthersHoles) {
  const LightmapFolder folder = both();
  for (const int padding : {1, 2, 4}) {
    const PageLayout layout = lay_out_pages(folder, {64, padding});
    ASSERT_EQ(layout.pages.size(), 1U);
    EXPECT_EQ(layout.pages[0].width, (side + 2 * padding + 3) / 4 * 4);
    EXPECT_EQ(layout.pages[0].height, layout.pages[0].width);
    const auto frame = std::size_t(side + 2 * padding), inner = std::size_t(side - 4 - 2 * padding);
    EXPECT_EQ(layout.taken,
              frame * frame - inner * inner + std::size_t(hole + 2 * padding) * (hole + 2 * padding));
  }
}

TEST_F(Interlocked, AreEachFilledFromItsOwnMap) {
  const LightmapFolder folder = both();
  const PageLayout layout = lay_out_pages(folder, {64, 3});
  const Page page = compose_page(folder, layout, 0, {""});
  for (const PagedMap& map : layout.maps) {
    const float light = map.key == "frame" ? 1 : 2;
    const TexelBits own = grown(map.surface, 3);
    for (int y = 0; y < own.height(); ++y) {
      for (int x = 0; x < own.width(); ++x) {
        if (!own.at(x, y)) continue;
        EXPECT_EQ(page.layers[0].pixels.texel(map.x + x, map.y + y)[0], light) << map.key;
      }
    }
  }
}

TEST_F(Interlocked, AreSeveralOnPagesOfOneSizeWhereAsked) {
  const PageLayout tight = lay_out_pages(both(), {side + 16, 8});  // which leaves too small a hole
  ASSERT_EQ(tight.pages.size(), 2U);
  EXPECT_LT(tight.pages[1].width, tight.pages[0].width);
  const PageLayout alike = lay_out_pages(both(), {side + 16, 8, true});
  ASSERT_EQ(alike.pages.size(), 2U);
  EXPECT_EQ(alike.pages[1].width, alike.pages[0].width);
  EXPECT_EQ(alike.pages[1].height, alike.pages[0].height);
}

TEST_F(Interlocked, LeaveRoomForFacesBetweenTexels) {
  const LightmapFolder folder = both();
  const float at = 8.25F / side,
              thin = 0.1F / side;  // a strip in the frame's hole that holds no texel's centre
  const std::vector<std::vector<Vec2>> uvs{{{at, 0.25F}, {at + thin, 0.25F}, {at, 0.75F}}, {}};
  const PageLayout layout = lay_out_pages(folder, {64, 2}, uvs);
  const Page page = compose_page(folder, layout, 0, {""});
  const PagedMap& frame = layout.maps[0];
  EXPECT_EQ(frame.covered, std::size_t(side * side - (side - 4) * (side - 4)));
  EXPECT_EQ(frame.surface.count(), frame.covered + side / 2);
  for (int y = side / 4; y < 3 * side / 4; ++y) {
    for (int x = 8 - 2; x <= 8 + 2; ++x)
      EXPECT_EQ(page.layers[0].pixels.texel(frame.x + x - frame.left, frame.y + y - frame.top)[0], 1);
    EXPECT_EQ(page.seen.texel(frame.x + 8 - frame.left, frame.y + y - frame.top)[0], 1);
  }
}

TEST_F(Pages, AreSeveralWhereOneIsTooSmall) {
  const PageLayout layout = lay_out_pages(maps(), {28, 2});
  EXPECT_GT(layout.pages.size(), 1U);
  for (const RectSize& page : layout.pages) EXPECT_TRUE(page.width <= 28 && page.height <= 28);
}

TEST_F(Pages, NameTheObjectThatIsTooLarge) {
  try {
    (void)lay_out_pages(maps(), {20, 2});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unsupported);
    EXPECT_NE(std::string(error.what()).find("b: its map takes 11 x 26 texels"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace rnmbake
