#include "bake/texel_centres.h"

#include "bake/fixture.h"
#include "scene/uv_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace rnmbake {
namespace {

using Uvs = std::array<Vec2, 3>;

/// Whether Blender would bake one of the map's texels by the triangle. `x`, `y`: of the map in its atlas,
/// texels.
bool holds_centre(const Uvs& uv, const RectSize& map, const RectSize& atlas, int x, int y) {
  const Vec2 size(float(map.width), float(map.height)), whole(float(atlas.width), float(atlas.height));
  std::vector<Vec2> placed;
  for (const Vec2& corner : uv) placed.push_back((corner * size + Vec2(float(x), float(y))) / whole);
  const UvRaster raster = rasterize(placed, atlas.width, atlas.height);
  const int top = atlas.height - y - map.height;
  for (int row = top; row < top + map.height; ++row) {
    for (int column = x; column < x + map.width; ++column) {
      if (raster.at(column, row).triangle >= 0) return true;
    }
  }
  return false;
}

/// Texels between the triangle and the nearest centre of the map.
double distance_to_centres(const Uvs& uv, const RectSize& map) {
  std::array<Vec3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = {double(uv[k].x) * map.width - 0.5, double(uv[k].y) * map.height - 0.5, 0};
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const Vec3d centre(x, y, 0);
      int left = 0, right = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d edge = corners[(k + 1) % 3] - corners[k], way = centre - corners[k];
        const double side = edge.cross(way).z, length2 = edge.length2();
        left += side > 0 ? 1 : 0;
        right += side < 0 ? 1 : 0;
        const double t = length2 > 0 ? std::clamp(way.dot(edge) / length2, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, (way - edge * t).length());
      }
      if (left == 3 || right == 3) return 0;
    }
  }
  return nearest;
}

/// Small and large triangles, slivers, points and lines, in and around the map.
class RandomTriangles {
 public:
  Uvs next(const RectSize& map) {
    const Vec2 size(float(map.width), float(map.height));
    const float scale = std::exp(between(-4, 2)), flatness = flat_(random_) ? 0.001F : 1.0F;
    const Vec2 centre(between(-1, size.x + 1), between(-1, size.y + 1));
    const float angle = between(0, 6.2832F);
    Uvs uv;
    for (Vec2& corner : uv) {
      const Vec2 place(scale * between(-1, 1), scale * flatness * between(-1, 1));
      const Vec2 turned(place.x * std::cos(angle) - place.y * std::sin(angle),
                        place.x * std::sin(angle) + place.y * std::cos(angle));
      corner = (centre + turned) / size;
    }
    if (line_(random_)) uv[2] = uv[1];
    return uv;
  }

  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

 private:
  std::mt19937 random_{11};
  std::bernoulli_distribution flat_{0.3}, line_{0.05};
};

TEST(TexelCentres, NoTriangleThatBakesATexelIsLeftOut) {
  RandomTriangles triangles;
  int baked = 0, left_out = 0;
  for (const RectSize map : {RectSize{1, 1}, {7, 5}, {16, 3}}) {
    for (int i = 0; i < 20000; ++i) {
      const Uvs uv = triangles.next(map);
      const int x = int(triangles.between(0, 40)), y = int(triangles.between(0, 40));
      const bool kept = may_hold_centre(uv, map);
      left_out += kept ? 0 : 1;
      if (!holds_centre(uv, map, {64, 64}, x, y)) continue;
      ++baked;
      EXPECT_TRUE(kept) << uv[0] << uv[1] << uv[2] << " in " << map.width << " x " << map.height;
    }
  }
  EXPECT_GT(baked, 5000);
  EXPECT_GT(left_out, 5000);
}

TEST(TexelCentres, DecidesByTheDistanceToTheNearestCentre) {
  RandomTriangles triangles;
  for (const RectSize map : {RectSize{1, 1}, {7, 5}, {16, 3}}) {
    for (int i = 0; i < 20000; ++i) {
      const Uvs uv = triangles.next(map);
      const double distance = distance_to_centres(uv, map);
      if (distance < 0.999 * centre_margin) {
        EXPECT_TRUE(may_hold_centre(uv, map)) << distance << uv[0] << uv[1] << uv[2];
      }
      // The margin is along each axis, so in between it is longer.
      if (distance > 1.001 * std::sqrt(2) * centre_margin) {
        EXPECT_FALSE(may_hold_centre(uv, map)) << distance << uv[0] << uv[1] << uv[2];
      }
    }
  }
}

TEST(TexelCentres, UvsThatAreNoNumbersHoldNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(may_hold_centre({Vec2(nan, 0), Vec2(nan, 1), Vec2(nan, nan)}, {8, 8}));
  EXPECT_TRUE(may_hold_centre({Vec2(-1e30F, 0), Vec2(1e30F, 0), Vec2(0, 1e30F)}, {8, 8}));
}

TEST(TexelCentres, WhatStaysKeepsItsOrderAndItsCorners) {
  const RectSize map{4, 4};
  std::vector<ReceiverCorner> corners;
  std::vector<std::size_t> expected;
  RandomTriangles triangles;
  for (std::size_t i = 0; i < 200; ++i) {
    const Uvs uv = triangles.next(map);
    for (const Vec2& corner : uv) corners.push_back({Vec3(float(i), 0, 0), Vec3(0, 0, 1), corner});
    if (may_hold_centre(uv, map)) expected.push_back(i);
  }
  ASSERT_GT(expected.size(), 10U);
  ASSERT_LT(expected.size(), 190U);
  const std::vector<ReceiverCorner> before = corners;
  drop_between_centres(corners, map);
  ASSERT_EQ(corners.size(), 3 * expected.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ReceiverCorner& same = before[3 * expected[i / 3] + i % 3];
    EXPECT_EQ(corners[i].position, same.position);
    EXPECT_EQ(corners[i].uv, same.uv);
  }
}

}  // namespace
}  // namespace rnmbake
