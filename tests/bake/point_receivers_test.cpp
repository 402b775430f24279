#include "bake/point_receivers.h"

#include "bake/fixture.h"
#include "scene/uv_raster.h"

#include <limits>

namespace rnmbake {
namespace {

const std::vector<Vec3> around{
    {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, Vec3(1, -1, 1).normalized(), Vec3(-0.3F, 0.2F, -0.01F).normalized()};

/// Points from the origin to 100,000 units off it.
std::vector<Vec3d> scattered(std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double far = i % 7 == 0 ? 0 : std::pow(10.0, double(i % 7) - 1);
    points.push_back(direction_at(0.1 * double(i), 0.7 * double(i)) * far);
  }
  return points;
}

TEST(PointMap, HasATexelForEachAndIsAboutSquare) {
  for (const std::size_t points : {1U, 2U, 3U, 5U, 100U, 1000U, 1023U, 1024U}) {
    const RectSize map = point_map(points);
    EXPECT_GE(std::size_t(map.width) * std::size_t(map.height), points);
    EXPECT_LT(std::size_t(map.width) * std::size_t(map.height - 1), points) << "a row without a point";
    EXPECT_LE(map.width - map.height, 1);
  }
  EXPECT_EQ(point_map(0).width, 0);
}

TEST(PointReceivers, CoverTheCentreOfOneTexelEach) {
  const std::vector<Vec3d> points = scattered(1000);
  const ReceiverPasses passes = make_point_receivers(points, around);
  ASSERT_EQ(passes.passes.size(), around.size());
  const RectSize map = point_map(points.size());
  for (const ReceiverPass& pass : passes.passes) {
    std::vector<Vec2> uv;
    for (const ReceiverCorner& corner : pass.corners) uv.push_back(corner.uv);
    const UvRaster raster = rasterize(uv, map.width, map.height);
    for (std::size_t i = 0; i < points.size(); ++i) {
      // Row 0 of a raster is on top.
      const int x = int(i) % map.width, y = map.height - 1 - int(i) / map.width;
      ASSERT_EQ(raster.at(x, y).triangle, int(i));
      // Weights of the centre, well inside.
      EXPECT_NEAR(raster.at(x, y).b1, 0.25, 1e-3);
      EXPECT_NEAR(raster.at(x, y).b2, 0.5, 1e-3);
    }
  }
}

TEST(PointReceivers, StandAtTheirPointsAndFaceTheirDirections) {
  const std::vector<Vec3d> points = scattered(200);
  const ReceiverPasses passes = make_point_receivers(points, around);
  for (std::size_t d = 0; d < around.size(); ++d) {
    const ReceiverPass& pass = passes.passes[d];
    EXPECT_EQ(pass.basis, d);
    ASSERT_EQ(pass.corners.size(), 3 * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ReceiverCorner* k = &pass.corners[3 * i];
      const Vec3d a(k[0].position), b(k[1].position), c(k[2].position);
      const double largest = std::max({std::abs(points[i].x), std::abs(points[i].y), std::abs(points[i].z)});
      const double rounding = largest * 0x1p-24, size = point_receiver_size(points[i]);
      EXPECT_LE((a * 0.25 + b * 0.25 + c * 0.5 - points[i]).length(), 2 * rounding + 1e-12);
      EXPECT_LE((a - points[i]).length(), 1.5 * size);
      // Three roundings of a corner move the face by at most sqrt(3) * 2^-24 of the largest coordinate over
      // an extent of 2 * 2^-15 of it, in two axes.
      const Vec3d face = (b - a).cross(c - a).normalized();
      EXPECT_LE((face - Vec3d(around[d])).length(), 2 * std::sqrt(3.0) * 0x1p-9);
      for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(k[n].normal, around[d]);
    }
  }
}

TEST(PointReceivers, AreSmallAgainstSpacingsAndLargeAgainstFloats) {
  EXPECT_EQ(point_receiver_size({0, 0, 0}), 1e-6);
  for (const double far : {0.1, 1.0, 1000.0, 1e6}) {
    const double step = std::nextafter(float(far), std::numeric_limits<float>::max()) - float(far);
    const double size = point_receiver_size({-far, 0.5 * far, 0});
    EXPECT_GE(size, 256 * step);
    EXPECT_LE(size, 4e-5 * far);
  }
}

TEST(PointReceivers, BecomeTasksOfWholeMaps) {
  Plan plan;
  const std::vector<Vec3d> points = scattered(10);
  add_receiver_tasks(plan, {"probes 0 to 9", point_map(10), ""}, make_point_receivers(points, around),
                     {"a", "b", "c", "d", "e"}, {});
  ASSERT_EQ(plan.tasks.size(), 5U);
  for (const AtlasRect& rect : plan.rects) {
    EXPECT_EQ(rect.x, 0);
    EXPECT_EQ(rect.y, 0);
    EXPECT_EQ(rect.size.width, 4);
    EXPECT_EQ(rect.size.height, 3);
  }
}

}  // namespace
}  // namespace rnmbake
