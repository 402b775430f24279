// Every map against its density: the density integrates to 1, and samples of the map follow it.
#include "sampling/maps.h"

#include "sampling/chi_square.h"

#include <numeric>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

double total(const std::vector<double>& cells) {
  return std::accumulate(cells.begin(), cells.end(), 0.0);
}

struct DirectionMap {
  std::string name;
  float lowest;  // height
  std::function<Vec3(const Vec2&)> map;
  std::function<double(const Vec3&)> pdf;
};

std::vector<DirectionMap> direction_maps() {
  const auto cosine = [](const Vec3& d) { return cosine_hemisphere_pdf(d.z); };
  const auto cone = [](float height) {
    return DirectionMap{"uniform_cone " + std::to_string(height), 1 - height,
                        [=](const Vec2& u) { return uniform_cone(height, u); },
                        [=](const Vec3&) { return uniform_cone_pdf(height); }};
  };
  return {cone(0.25F),
          cone(1),
          cone(2),
          {"uniform_hemisphere_polar", 0, uniform_hemisphere_polar,
           [](const Vec3&) { return uniform_hemisphere_pdf; }},
          {"cosine_hemisphere", 0, cosine_hemisphere, cosine},
          {"cosine_hemisphere_polar", 0, cosine_hemisphere_polar, cosine}};
}

TEST(MapsTest, DirectionsFollowTheirDensities) {
  for (const DirectionMap& it : direction_maps()) {
    const DirectionGrid grid(it.lowest);
    const std::vector<double> expected = grid.integrals(it.pdf);
    // The midpoint rule is exact for densities linear in the height; what is left are the densities' floats.
    EXPECT_NEAR(total(expected), 1, 1e-6) << it.name;
    EXPECT_GT(grid.tail(it.map, expected, 1), significance) << it.name;
  }
}

TEST(MapsTest, AnotherMapsDensityIsRefused) {
  const DirectionGrid grid(0);
  const auto cosine = grid.integrals([](const Vec3& d) { return cosine_hemisphere_pdf(d.z); });
  EXPECT_LT(grid.tail(uniform_hemisphere_polar, cosine, 1), significance);
}

TEST(MapsTest, DirectionsHaveLengthOne) {
  SplitMix64 random(2);
  for (const DirectionMap& it : direction_maps()) {
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u(static_cast<float>(random.next() >> 40) * 0x1p-24F,
                   static_cast<float>(random.next() >> 40) * 0x1p-24F);
      EXPECT_NEAR(it.map(u).length(), 1, 4 * 0x1p-23F) << it.name;
    }
  }
}

/// In polar coordinates, where no cell is cut by the rim.
TEST(MapsTest, TheDiskIsUniformPerArea) {
  const Grid grid{Vec2(0, -3.1415928F), Vec2(1, 3.1415928F)};
  const auto expected = grid.integrals([](double radius, double) { return uniform_disk_pdf * radius; });
  EXPECT_NEAR(total(expected), 1, 1e-6);
  const auto polar = [](const Vec2& u) {
    const Vec2 d = uniform_disk(u);
    return Vec2(std::min(d.length(), 1.0F), std::atan2(d.y, d.x));
  };
  EXPECT_GT(grid.tail(polar, expected, 3), significance);
}

/// By the share b1 + b2 of the way from corner 0, and the share of b2 in it: the triangle becomes a square in
/// which b1, b2 have the Jacobian b1 + b2.
TEST(MapsTest, TheTriangleIsUniformPerArea) {
  const Grid grid{Vec2(0, 0), Vec2(1, 1)};
  constexpr float area = 0.5F;  // of the barycentric coordinates' triangle
  const auto expected =
      grid.integrals([](double across, double) { return uniform_triangle_pdf(area) * across; });
  EXPECT_NEAR(total(expected), 1, 1e-6);
  const auto square = [](const Vec2& u) {
    const Vec2 b = uniform_triangle(u);
    const float across = std::min(b.x + b.y, 1.0F);
    return Vec2(across, across > 0 ? b.y / across : 0.0F);
  };
  EXPECT_GT(grid.tail(square, expected, 4), significance);
}

/// 1 - cosine of a cone a thousandth of a degree wide is below the spacing of floats around 1.
TEST(MapsTest, NarrowConesKeepTheirWidth) {
  constexpr float height = 1e-10F;
  double sum = 0;
  SplitMix64 random(5);
  constexpr int samples = 10000;
  for (int i = 0; i < samples; ++i) {
    const Vec3 d = uniform_cone(height, {static_cast<float>(random.next() >> 40) * 0x1p-24F,
                                         static_cast<float>(random.next() >> 40) * 0x1p-24F});
    sum += (double(d.x) * d.x + double(d.y) * d.y) / (2 * double(height));  // uniform in [0, 1]
  }
  EXPECT_NEAR(sum / samples, 0.5, 5 * std::sqrt(1.0 / 12 / samples));
}

}  // namespace
}  // namespace rnmbake
