#include "trace/texel_samples.h"

#include "sampling/sampler.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr int side = 4;  // texels of the map

/// One triangle in the plane z = 0 whose positions are its UVs in texels.
Surface triangle_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  Surface surface;
  SurfaceTriangle triangle;
  const Vec2 corners[3] = {a, b, c};
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.corners[k] = {Vec3(corners[k].x, corners[k].y, 0),
                           {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), 1},
                           corners[k] / float(side)};
  }
  triangle.normal = Vec3(0, 0, 1);
  surface.triangles.push_back(triangle);
  return surface;
}

/// Positions of `count` samples of the only texel.
std::vector<Vec3> positions(const Surface& surface, Footprint footprint, PastEdge past_edge, int count) {
  const TexelSamples texel_samples(surface, side, side, footprint, past_edge);
  EXPECT_EQ(texel_samples.texels().size(), 1U);
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(7, static_cast<std::uint32_t>(i));
    result.push_back(texel_samples.sample(0, sampler.next2()).position);
  }
  return result;
}

Vec3d mean_of(const std::vector<Vec3>& points) {
  Vec3d sum(0, 0, 0);
  for (const Vec3& point : points) sum += Vec3d(point);
  return sum / double(points.size());
}

// The texel's centre is (1.5, 1.5) and just inside the long edge x + y = 3.04 of a triangle far larger than
// it.
const Vec2 low(1.0F, 1.0F), right(2.04F, 1.0F), top(1.0F, 2.04F);

TEST(TexelSamples, WithinTheTriangleASampleIsWhereTheFootprintSays) {
  for (const PastEdge past_edge : {PastEdge::mirror, PastEdge::retry}) {
    const Surface surface = triangle_of(low, right, top);
    const TexelSamples texel_samples(surface, side, side, Footprint::full, past_edge);
    const GatherPoint point = texel_samples.sample(0, Vec2(0.25F, 0.125F));
    EXPECT_NEAR(point.position.x, 1.5 - 0.25, 1e-5);
    EXPECT_NEAR(point.position.y, 1.5 - 0.375, 1e-5);
  }
}

// By hand: at (1.75, 1.75) the weights of low, right, top are -0.4423, 0.7212, 0.7212. The first becomes
// 0.4423, the second is folded at what is left, 0.5577: 0.3942, the third is the rest.
TEST(TexelSamples, MirroringFoldsTheFirstWeightThenTheSecond) {
  const Surface surface = triangle_of(low, right, top);
  const TexelSamples texel_samples(surface, side, side, Footprint::half, PastEdge::mirror);
  const GatherPoint point = texel_samples.sample(0, Vec2(1, 1));
  const double right_weight = 0.75 / 1.04, left_over = 1 - (2 * right_weight - 1);
  const double folded = 2 * left_over - right_weight;
  EXPECT_NEAR(point.position.x, 1 + 1.04 * folded, 1e-5);
  EXPECT_NEAR(point.position.y, 1 + 1.04 * (left_over - folded), 1e-5);
}

TEST(TexelSamples, RetryingSpreadsSamplesEvenlyOverWhatLiesInside) {
  // Of the half texel, the corner beyond x + y = 3.04 is missing.
  const std::vector<Vec3> points =
      positions(triangle_of(low, right, top), Footprint::half, PastEdge::retry, 65536);
  for (const Vec3& p : points) EXPECT_LT(p.x + p.y, 3.04F + 1e-5F);
  double count = 0, x = 0, y = 0;
  for (int i = 0; i < 1000; ++i) {
    for (int j = 0; j < 1000; ++j) {
      const double px = 1.25 + 0.5 * (i + 0.5) / 1000, py = 1.25 + 0.5 * (j + 0.5) / 1000;
      if (px + py >= 3.04) continue;
      ++count;
      x += px;
      y += py;
    }
  }
  const Vec3d mean = mean_of(points);
  const double error = 0.5 / std::sqrt(12.0 * double(points.size()));  // of an even spread over half a texel
  EXPECT_NEAR(mean.x, x / count, 4 * error);
  EXPECT_NEAR(mean.y, y / count, 4 * error);
}

TEST(TexelSamples, WhereTenTriesFailTheCentreIsTaken) {
  // About 1/25 of the texel: ten tries miss it with a chance of 0.96^10.
  const Vec2 a(1.4F, 1.4F), b(1.7F, 1.4F), c(1.4F, 1.6667F);
  const std::vector<Vec3> points = positions(triangle_of(a, b, c), Footprint::full, PastEdge::retry, 65536);
  const auto centres = std::count_if(points.begin(), points.end(), [](const Vec3& p) {
    return std::abs(p.x - 1.5F) < 1e-5F && std::abs(p.y - 1.5F) < 1e-5F;
  });
  const double share = std::pow(1 - 0.04, 10), spread = std::sqrt(share * (1 - share) / 65536);
  EXPECT_NEAR(double(centres) / 65536, share, 4 * spread);
}

}  // namespace
}  // namespace rnmbake
