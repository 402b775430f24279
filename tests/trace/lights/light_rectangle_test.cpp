#include "trace/lights/light_rectangle.h"

#include "trace/lights/light_support.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Of a rectangle seen from a height above one of its corners.
double corner_angle(double a, double b, double height) {
  return std::atan2(a * b, height * std::sqrt(a * a + b * b + height * height));
}

TEST(LightRectangleTest, SolidAngleIsItsClosedForm) {
  for (const float height : {0.01F, 0.3F, 2.0F, 9.0F}) {
    const SeenRectangle middle({0, 0, 0}, {0, 0, height}, {0.7F, 0, 0}, {0, 0.4F, 0});
    ASSERT_TRUE(middle.usable());
    const double expected = 4 * corner_angle(0.7, 0.4, height);
    EXPECT_NEAR(middle.solid_angle(), expected, 1e-5 * expected) << height;
    const SeenRectangle aside({0, 0, 0}, {2, 1, -height}, {0.7F, 0, 0}, {0, 0.4F, 0});
    const double beside = corner_angle(2.7, 1.4, height) - corner_angle(1.3, 1.4, height) -
                          corner_angle(2.7, 0.6, height) + corner_angle(1.3, 0.6, height);
    if (aside.usable()) {
      EXPECT_NEAR(aside.solid_angle(), beside, 1e-4 * beside) << height;
    }
  }
}

TEST(LightRectangleTest, SmallOnesSkewedOnesAndThoseInThePlaneAreDeclined) {
  EXPECT_FALSE(SeenRectangle({0, 0, 0}, {0, 0, 1e4F}, {1, 0, 0}, {0, 1, 0}).usable());
  EXPECT_FALSE(SeenRectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0.5F, 1, 0}).usable());
  EXPECT_FALSE(SeenRectangle({0, 0, 0}, {3, 0, 0}, {1, 0, 0}, {0, 1, 0}).usable());
  EXPECT_FALSE(SeenRectangle({0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}).usable());
}

/// Every cell of [0,1)^2 must get its share of the solid angle: the mean of a function of the direction
/// tells.
TEST(LightRectangleTest, PlacesAreEvenPerSolidAngle) {
  const Vec3 centre(0.5F, -0.2F, 0.6F), u(1, 0, 0), v(0, 0.5F, 0);
  const SeenRectangle seen({0, 0, 0}, centre, u, v);
  constexpr int steps = 600;
  Vec3d sampled(0, 0, 0), quadrature(0, 0, 0);
  double whole = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vec2 w((static_cast<float>(i) + 0.5F) / steps, (static_cast<float>(j) + 0.5F) / steps);
      const Vec3 place = seen.place(w);
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

}  // namespace
}  // namespace rnmbake
