#include "sampling/spherical_triangle.h"

#include "sampling/chi_square.h"

#include <numeric>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const Vec3 corner(-0.4F, -0.3F, 0.7F), edge1(1.2F, 0.1F, 0.2F), edge2(0.1F, 0.9F, -0.3F);

SphericalTriangle seen(const Vec3& to_corner) {
  const Vec3 normal = edge1.cross(edge2);
  return {to_corner, edge1, edge2, normal.normalized(), normal.length() / 2};
}

/// Solid angle per area of the square that the triangle is made of: b1 + b2 and the share of b2 in it.
double solid_angle_density(double across, double share) {
  const Vec3d at = Vec3d(corner) + Vec3d(edge1) * (across * (1 - share)) + Vec3d(edge2) * (across * share);
  return std::abs(at.dot(Vec3d(edge1).cross(Vec3d(edge2)))) * across / std::pow(at.length(), 3);
}

/// Where a direction meets the plane, in that square.
Vec2 square_of(const Vec3& direction) {
  const Vec3d n = Vec3d(edge1).cross(Vec3d(edge2)), d(direction);
  const Vec3d on = d * (Vec3d(corner).dot(n) / d.dot(n)) - Vec3d(corner);
  const double b1 = on.cross(Vec3d(edge2)).dot(n) / n.length2(),
               b2 = Vec3d(edge1).cross(on).dot(n) / n.length2();
  // Directions are floats: at the triangle's edges they may lie just outside.
  const auto clamped = [](double v) {
    return static_cast<float>(v < 0 && v > -1e-5 ? 0 : v > 1 && v < 1 + 1e-5 ? 1 : v);
  };
  return {clamped(b1 + b2), clamped(b1 + b2 > 1e-6 ? b2 / (b1 + b2) : 0)};
}

TEST(SphericalTriangleTest, DirectionsAreUniformPerSolidAngle) {
  const SphericalTriangle triangle = seen(corner);
  ASSERT_TRUE(triangle.usable());
  const Grid grid{Vec2(0, 0), Vec2(1, 1)};
  const auto expected = grid.integrals(
      [&](double across, double share) { return triangle.pdf() * solid_angle_density(across, share); });
  EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), 1, 1e-5);
  EXPECT_GT(grid.tail([&](const Vec2& u) { return square_of(triangle.sample(u)); }, expected, 12),
            significance);
}

TEST(SphericalTriangleTest, SmallOnesAndThoseEdgeOnAreDeclined) {
  EXPECT_FALSE(seen(corner * 100.0F).usable());
  EXPECT_FALSE(seen(edge1 * -0.3F + edge2 * -0.3F).usable());  // from within its plane
}

}  // namespace
}  // namespace rnmbake
