// Gathering at points in free space, with the estimator of texels.
#include "encoding/basis_set.h"
#include "trace/block.h"
#include "trace/gather_point.h"
#include "trace/trace_scenes.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

class FreePoints : public PointSource {
 public:
  explicit FreePoints(std::vector<GatherPoint> points) : points_(std::move(points)) {}
  [[nodiscard]] std::size_t size() const override { return points_.size(); }
  [[nodiscard]] GatherPoint sample(std::size_t index, const Vec2& /*u*/) const override {
    return points_[index];
  }

 private:
  std::vector<GatherPoint> points_;
};

/// One unit over the plane, facing along `normal`.
GatherPoint over_the_plane(const Vec3& normal, const Vec3& tangent) {
  GatherPoint point;
  point.position = Vec3(0, 0, 1);
  point.face = normal;
  point.frame = {tangent, normal.cross(tangent), normal, 1};
  return point;
}

/// Under a sky of radiance 1 a plane of albedo a reflects radiance a: E/pi is 1 for a point that faces up, a
/// for one that faces down, and their mean for one that faces the horizon.
TEST(GatherPoints, OverAPlaneUnderAConstantSky) {
  constexpr float albedo = 0.6F, half = 1e4F;
  DiffuseScene scene;
  add_object(scene, "plane", {level(half, 0)}, Vec3(albedo));
  scene.world.radiance = Vec3(1);
  const TraceScene traced(scene, "4.3.2");
  const FreePoints points({over_the_plane({0, 0, 1}, {1, 0, 0}), over_the_plane({1, 0, 0}, {0, 1, 0}),
                           over_the_plane({0, 0, -1}, {1, 0, 0})});
  const double truth[] = {1, (1 + double{albedo}) / 2, albedo};

  for (const bool reuse : {true, false}) {
    GatherOptions options;
    options.directions = {flat_direction()};
    options.reuse = reuse;
    BlockGatherer gatherer(traced, points, options, nullptr);
    BatchStatistics statistics(points.size(), gatherer.values());
    for (std::uint64_t batch = 0; batch < 64; ++batch)
      gatherer.batch(0, points.size(), 256, hash_of(1, batch), statistics);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double error = std::sqrt(statistics.squared_error(i, 0).y);
      EXPECT_LT(error, 1.5e-3) << "the test is too weak";
      // Past the plane's rim, at most 1 / half below the horizon, is sky.
      EXPECT_NEAR(statistics.mean(i, 0).y, truth[i], 4.5 * error + 1 / half) << i << " reuse " << reuse;
    }
  }
}

}  // namespace
}  // namespace rnmbake
