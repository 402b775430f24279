#include "pipeline/deliver/pages.h"

#include "base/error.h"
#include "base/files.h"
#include "lightmap/metadata.h"

#include <cstddef>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Covered but for two rows on top and a column at the right; each texel holds its own place.
LightmapPlace write_map(const TempFolder& folder, const std::string& key, int width, int height) {
  LightmapMetadata metadata;
  metadata.bases = {flat_direction()};
  metadata.object = key;
  LayeredImage image;
  image.layers = {{"", {"R", "G", "B"}, {width, height, 3}}, {"coverage", {""}, {width, height, 1}}};
  for (int y = 2; y < height; ++y) {
    for (int x = 0; x < width - 1; ++x) {
      set_vec3(image.layers[0].pixels, x, y, {float(x), float(y), float(key[0])});
      image.layers[1].pixels.texel(x, y)[0] = 1;
    }
  }
  write_metadata(metadata, image);
  const auto file = folder.path() / (key + ".exr");
  write_exr(file, image, Depth::half);
  return {key, {file}, {}};
}

class Pages : public testing::Test {
 protected:
  LightmapFolder maps() {
    LightmapFolder found{folder_.path(), false, {}, {}, {}};
    for (const auto& [key, width, height] : {std::tuple{"a", 16, 16}, {"b", 8, 24}, {"c", 20, 10}})
      found.places.push_back(write_map(folder_, key, width, height));
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
