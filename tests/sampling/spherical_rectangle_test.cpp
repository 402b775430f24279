#include "sampling/spherical_rectangle.h"

#include "sampling/chi_square.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Of a rectangle seen from a height above one of its corners.
double corner_angle(double a, double b, double height) {
  return std::atan2(a * b, height * std::sqrt(a * a + b * b + height * height));
}

TEST(SphericalRectangleTest, SolidAngleIsItsClosedForm) {
  for (const float height : {0.01F, 0.3F, 2.0F, 9.0F}) {
    const SphericalRectangle middle({0, 0, 0}, {0, 0, height}, {0.7F, 0, 0}, {0, 0.4F, 0});
    ASSERT_TRUE(middle.usable());
    const double expected = 4 * corner_angle(0.7, 0.4, height);
    EXPECT_NEAR(middle.solid_angle(), expected, 1e-5 * expected) << height;
    const SphericalRectangle aside({0, 0, 0}, {2, 1, -height}, {0.7F, 0, 0}, {0, 0.4F, 0});
    const double beside = corner_angle(2.7, 1.4, height) - corner_angle(1.3, 1.4, height) -
                          corner_angle(2.7, 0.6, height) + corner_angle(1.3, 0.6, height);
    if (aside.usable()) {
      EXPECT_NEAR(aside.solid_angle(), beside, 1e-4 * beside) << height;
    }
  }
}

TEST(SphericalRectangleTest, SmallOnesSkewedOnesAndThoseInThePlaneAreDeclined) {
  EXPECT_FALSE(SphericalRectangle({0, 0, 0}, {0, 0, 1e4F}, {1, 0, 0}, {0, 1, 0}).usable());
  EXPECT_FALSE(SphericalRectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0.5F, 1, 0}).usable());
  EXPECT_FALSE(SphericalRectangle({0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {0, 1, 0}).usable());
  EXPECT_FALSE(SphericalRectangle({0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}).usable());
}

/// Every cell of [0,1)^2 must get its share of the solid angle: the mean of a function of the direction
/// tells.
TEST(SphericalRectangleTest, PlacesAreEvenPerSolidAngle) {
  const Vec3 centre(0.5F, -0.2F, 0.6F), u(1, 0, 0), v(0, 0.5F, 0);
  const SphericalRectangle seen({0, 0, 0}, centre, u, v);
  constexpr int steps = 600;
  Vec3d sampled(0, 0, 0), quadrature(0, 0, 0);
  double whole = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vec2 w((static_cast<float>(i) + 0.5F) / steps, (static_cast<float>(j) + 0.5F) / steps);
      const Vec3 place = seen.sample(w);
      EXPECT_NEAR(place.z, 0.6F, 1e-5F);
      EXPECT_LE(std::abs(place.x - 0.5F), 1.00001F);
      EXPECT_LE(std::abs(place.y + 0.2F), 0.50001F);
      sampled += Vec3d(place).normalized() / (double(steps) * steps);
      const Vec3d at =
          Vec3d(centre) + Vec3d(u) * (2.0 * double(w.x) - 1) + Vec3d(v) * (2.0 * double(w.y) - 1);
      const double share = at.z / std::pow(at.length(), 3);
      quadrature += at.normalized() * share;
      whole += share;
    }
  }
  quadrature /= whole;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sampled[k], quadrature[k], 1e-5);
}

TEST(SphericalRectangleTest, PointsFollowTheDensity) {
  const SphericalRectangle seen({0, 0, 0}, {0.5F, -0.2F, 0.6F}, {1, 0, 0}, {0, 0.5F, 0});
  const Grid grid{Vec2(-0.5F, -0.7F), Vec2(1.5F, 0.3F)};
  const auto expected = grid.integrals(
      [&](double x, double y) { return seen.pdf() * 0.6 / std::pow(x * x + y * y + 0.36, 1.5); });
  EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), 1, 1e-5);
  const auto map = [&](const Vec2& u) {
    const Vec3 point = seen.sample(u);
    // Floats may lie on the edge, or just past it.
    return Vec2(std::clamp(point.x, -0.5F, 1.5F), std::clamp(point.y, -0.7F, 0.3F));
  };
  EXPECT_GT(grid.tail(map, expected, 10), significance);
}

}  // namespace
}  // namespace rnmbake
