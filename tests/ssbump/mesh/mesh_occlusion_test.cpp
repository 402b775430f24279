#include "ssbump/mesh/mesh_occlusion.h"

#include "encoding/rnm.h"
#include "ssbump/low_high.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

MeshOcclusionOptions options_of(int side) {
  MeshOcclusionOptions options;
  options.width = options.height = side;
  options.cage = 0.5;
  options.parts = 1;
  return options;
}

struct Mean {
  double value = 0, error = 0;
};

/// Over all texels of one channel, from several independent runs.
Mean mean_of(const HighMesh& high, const LowSurface& low, MeshOcclusionOptions options, int channel) {
  double sum = 0, squares = 0, count = 0;
  for (options.seed = 1; options.seed <= 4; ++options.seed) {
    const MeshOcclusion maps = measure_occlusion(high, {&low, 1}, options);
    for (int y = 0; y < options.height; ++y) {
      for (int x = 0; x < options.width; ++x) {
        const double value = maps.weights.image.texel(x, y)[std::size_t(channel)];
        sum += value;
        squares += value * value;
        ++count;
      }
    }
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

/// The share of max(0, D . axis)^power over the upper hemisphere that `visible` lets through, by the midpoint
/// rule.
template <typename Visible>
double share(const Vec3& axis, double power, const Visible& visible) {
  constexpr int steps = 1000;
  double seen = 0, whole = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = (i + 0.5) / steps, r = std::sqrt(1 - z * z);
    for (int j = 0; j < steps; ++j) {
      const double angle = 2 * pi * (j + 0.5) / steps;
      const Vec3d d(r * std::cos(angle), r * std::sin(angle), z);
      const double weight = std::pow(std::max(0.0, d.dot(Vec3d(axis))), power);
      whole += weight;
      if (visible(d)) seen += weight;
    }
  }
  return seen / whole;
}

TEST(MeshOcclusion, NothingShadesAFlatFloor) {
  const LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  for (const double power : {1.0, 3.0}) {
    MeshOcclusionOptions options = options_of(8);
    options.parts = 2;
    options.power = power;
    const MeshOcclusion maps = measure_occlusion(floor_at(0.25F), {&low, 1}, options);
    for (const float weight : maps.weights.image.data()) EXPECT_EQ(weight, 1.0F);
    for (const float height : maps.height.data()) EXPECT_NEAR(height, 0.25, 1e-5);
    for (const float found : maps.found.data()) EXPECT_EQ(found, 1.0F);
    EXPECT_EQ(maps.surfaces[0].texels, 64U);
    EXPECT_EQ(maps.surfaces[0].missed, 0U);
  }
}

TEST(MeshOcclusion, AnEndlessWallHidesHalfOfTheSky) {
  HighMesh high = floor_at(0);
  const float s = 1e4F;
  add_quad(high, {Vec3(2, s, -1), {2, -s, -1}, {2, -s, s}, {2, s, s}});  // blocks whatever goes towards +x
  const LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  const double root = std::sqrt(1.0 / 3);
  // Between the wall's plane and that of B0, which share an axis, the integral of D . B0 is a lune's.
  const double first = (1 - std::sqrt(2.0 / 3)) / (1 + root);
  const Mean right = mean_of(high, low, options_of(8), 0);
  EXPECT_NEAR(right.value, first, 4 * right.error);
  EXPECT_LT(right.error, 0.002);
  const Mean up = mean_of(high, low, options_of(8), SsbumpWeights::up);
  EXPECT_NEAR(up.value, 0.5, 4 * up.error);

  const auto open = [](const Vec3d& d) { return d.x < 0; };
  const auto basis = rnm_basis();
  EXPECT_NEAR(share(basis[0], 1, open), first, 1e-4);
  for (const int channel : {1, 2}) {
    const Mean side = mean_of(high, low, options_of(8), channel);
    EXPECT_NEAR(side.value, share(basis[std::size_t(channel)], 1, open), 4 * side.error) << channel;
  }
}

TEST(MeshOcclusion, PowerAndReachAreHeeded) {
  HighMesh high = floor_at(0);
  const float s = 1e4F;
  add_quad(high, {Vec3(2, s, -1), {2, -s, -1}, {2, -s, s}, {2, s, s}});
  const LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  MeshOcclusionOptions options = options_of(8);
  options.power = 4;
  const Mean sharp = mean_of(high, low, options, 0);
  EXPECT_NEAR(sharp.value, share(rnm_basis()[0], 4, [](const Vec3d& d) { return d.x < 0; }), 4 * sharp.error);
  const Mean ambient = mean_of(high, low, options, SsbumpWeights::ambient);
  EXPECT_NEAR(ambient.value, 0.5, 4 * ambient.error);

  options.reach = 0.5;  // every texel is farther from the wall
  const MeshOcclusion maps = measure_occlusion(high, {&low, 1}, options);
  for (const float weight : maps.weights.image.data()) EXPECT_EQ(weight, 1.0F);
}

TEST(MeshOcclusion, ATiltedFaceHidesItsOwnLowerSide) {
  // A roof without an underside: a ray that goes below its plane is blocked though nothing is there.
  HighMesh high;
  const float slope = 0.75F, s = 50;
  add_quad(high, {Vec3(-s, -s, -s * slope), {s, -s, s * slope}, {s, s, s * slope}, {-s, s, -s * slope}});
  const LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  MeshOcclusionOptions options = options_of(8);
  options.cage = 2;
  const auto above = [&](const Vec3d& d) { return d.z > double{slope} * d.x; };
  for (int channel = 0; channel < 3; ++channel) {
    const Mean mean = mean_of(high, low, options, channel);
    EXPECT_NEAR(mean.value, share(rnm_basis()[std::size_t(channel)], 1, above), 4 * mean.error) << channel;
  }
  const MeshOcclusion maps = measure_occlusion(high, {&low, 1}, options);
  const Vec3 normal = unit(Vec3(-slope, 0, 1));
  for (int x = 0; x < 8; ++x) {
    EXPECT_NEAR(maps.height.texel(x, 3)[0], slope * (-1 + 0.25 * (x + 0.5)), 1e-4);
    EXPECT_NEAR(maps.normal.texel(x, 3)[0], normal.x, 1e-5);
    EXPECT_NEAR(maps.normal.texel(x, 3)[2], normal.z, 1e-5);
  }
}

TEST(MeshOcclusion, ChannelsFollowTheTangentFrameOfTheLowSurface) {
  HighMesh high = floor_at(0);
  const float s = 1e4F;
  add_quad(high, {Vec3(2, s, -1), {2, -s, -1}, {2, -s, s}, {2, s, s}});
  LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  for (SurfaceTriangle& triangle : low.surface.triangles) {
    for (SurfaceCorner& corner : triangle.corners)
      corner.frame = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, -1};  // mirrored: the wall is on its left
  }
  const auto open = [](const Vec3d& d) { return d.x > 0; };
  const Mean right = mean_of(high, low, options_of(8), 0);
  EXPECT_NEAR(right.value, share(rnm_basis()[0], 1, open), 4 * right.error);
}

TEST(MeshOcclusion, MissesAreCountedWhereTheyAre) {
  const std::vector<LowSurface> low{low_rectangle("found", {-1, -1}, {1, 1}, {0, 0}, {0.5F, 1}),
                                    low_rectangle("lost", {100, -1}, {102, 1}, {0.5F, 0}, {1, 1})};
  const MeshOcclusion maps = measure_occlusion(floor_at(0, 50), low, options_of(8));
  EXPECT_EQ(maps.surfaces[0].texels, 32U);
  EXPECT_EQ(maps.surfaces[0].missed, 0U);
  EXPECT_EQ(maps.surfaces[1].texels, 32U);
  EXPECT_EQ(maps.surfaces[1].missed, 32U);
  EXPECT_EQ(maps.surfaces[1].missed_x, 4);
  EXPECT_EQ(maps.surfaces[1].missed_y, 0);
  EXPECT_EQ(maps.found.texel(3, 5)[0], 1);
  EXPECT_EQ(maps.found.texel(4, 5)[0], 0);
  EXPECT_EQ(maps.covered.texel(4, 5)[0], 1);
  EXPECT_EQ(maps.weights.image.texel(4, 5)[0], 0);
}

TEST(MeshOcclusion, FrontsGoBeforeBacks) {
  const LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  HighMesh high = floor_at(0.1F);
  const float s = 50;
  add_quad(high,
           {Vec3(-s, s, 0.3F), {s, s, 0.3F}, {s, -s, 0.3F}, {-s, -s, 0.3F}});  // faces down, in the cage
  const MeshOcclusion both = measure_occlusion(high, {&low, 1}, options_of(4));
  EXPECT_EQ(both.surfaces[0].behind, 0U);
  EXPECT_NEAR(both.height.texel(1, 1)[0], 0.1, 1e-5);
  EXPECT_LT(both.weights.image.texel(1, 1)[0], 0.02F);  // under a lid

  HighMesh lid;
  lid.position.assign(high.position.begin() + 6, high.position.end());
  lid.normal.assign(high.normal.begin() + 6, high.normal.end());
  const MeshOcclusion back = measure_occlusion(lid, {&low, 1}, options_of(4));
  EXPECT_EQ(back.surfaces[0].behind, 16U);
  EXPECT_EQ(back.surfaces[0].missed, 0U);
  EXPECT_NEAR(back.height.texel(1, 1)[0], 0.3, 1e-5);
  EXPECT_NEAR(back.normal.texel(1, 1)[2], 1, 1e-6);
  EXPECT_EQ(back.weights.image.texel(1, 1)[0], 1.0F);
}

TEST(MeshOcclusion, ThreadsDoNotChangeIt) {
  HighMesh high = floor_at(0);
  add_quad(high, {Vec3(0, 1, -1), {0, -1, -1}, {0, -1, 1}, {0, 1, 1}});
  const LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  MeshOcclusionOptions options = options_of(16);
  options.threads = 1;
  const MeshOcclusion one = measure_occlusion(high, {&low, 1}, options);
  options.threads = 3;
  EXPECT_EQ(one.weights.image.data(), measure_occlusion(high, {&low, 1}, options).weights.image.data());
}

TEST(MeshOcclusion, BandsMeetWithoutAGap) {
  const LowSurface low = low_rectangle("low", {-1, -1}, {1, 1});
  MeshOcclusionOptions options = options_of(8);
  options.height = 70;
  options.rays = 4;
  const MeshOcclusion maps = measure_occlusion(floor_at(0), {&low, 1}, options);
  for (const float found : maps.found.data()) EXPECT_EQ(found, 1.0F);
}

TEST(LowTexels, OverlapsAreFoundBetweenSurfacesAndWithinOne) {
  std::vector<LowSurface> low{low_rectangle("a", {0, 0}, {1, 1}, {0, 0}, {0.5F, 1}),
                              low_rectangle("b", {2, 0}, {3, 1}, {0.25F, 0}, {0.75F, 1})};
  const LowSurface again = low_rectangle("b", {4, 0}, {5, 1}, {0.5F, 0}, {0.75F, 0.5F});
  auto& triangles = low[1].surface.triangles;
  triangles.insert(triangles.end(), again.surface.triangles.begin(), again.surface.triangles.end());
  const UvUse use = uv_use(low, 8, 8);
  EXPECT_EQ(use.texels, (std::vector<std::size_t>{32, 32}));
  ASSERT_EQ(use.overlaps.size(), 2U);
  EXPECT_EQ(use.overlaps[0].first, 0U);
  EXPECT_EQ(use.overlaps[0].second, 1U);
  EXPECT_EQ(use.overlaps[0].texels, 16U);
  EXPECT_EQ(use.overlaps[1].first, 1U);
  EXPECT_EQ(use.overlaps[1].second, 1U);
  EXPECT_EQ(use.overlaps[1].texels, 8U);
}

TEST(MeshOcclusion, TheCageIsAShareOfTheBox) {
  const LowSurface low = low_rectangle("low", {0, 0}, {3, 4});
  EXPECT_NEAR(default_cage({&low, 1}), 0.15, 1e-6);
}

}  // namespace
}  // namespace rnmbake
