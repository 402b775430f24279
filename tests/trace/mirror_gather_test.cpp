#include "trace/mirror_gather.h"

#include "trace/moments.h"
#include "trace/trace_scenes.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A floor under a small patch, which alone sends light: radiance `patch_light`, to all sides.
struct Patch {
  DiffuseScene scene;
  TraceScene traced;
  Surface floor;
  GatherTarget target;

  Patch() : scene(make()), traced(scene, "4.3.2"), floor(surface_of(scene, 0)), target{&floor, 0, 8, 8} {}

  static DiffuseScene make() {
    DiffuseScene scene;
    add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
    add_object(scene, "patch", {level(0.5F, 1, false)}, Vec3(0.5F));
    return scene;
  }

  /// What another renderer says of the rays.
  [[nodiscard]] std::vector<Vec3> answers(const std::vector<PrimaryRay>& rays) const {
    std::vector<Vec3> light;
    for (const PrimaryRay& ray : rays) {
      Hit hit;
      std::vector<TransparentHit> none;
      const bool met =
          traced.intersect({ray.origin, ray.direction, std::numeric_limits<float>::infinity()}, hit, none);
      light.push_back(met && traced.triangles().object[hit.triangle] == 1 ? Vec3(2, 1, 0) : Vec3(0));
    }
    return light;
  }
};

/// E/pi of a patch of radiance 1 at the texels, by the tracer itself.
Gathered truth(int samples) {
  DiffuseScene scene = Patch::make();
  scene.materials[1].emission = Vec3(1);
  scene.materials[0].albedo = scene.materials[1].albedo = Vec3(0);
  return gather_one(scene, 0, all_directions(samples));
}

double mean_of(const FloatImage& picture, int channel) {
  double sum = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) sum += picture.texel(x, y)[std::size_t(channel)];
  }
  return sum / (double(picture.width()) * picture.height());
}

/// Root mean square of the texels' errors, over the mean.
double noise(const FloatImage& picture, const FloatImage& expected) {
  double squares = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x)
      squares += std::pow(double(picture.texel(x, y)[1]) - expected.texel(x, y)[0], 2);
  }
  return std::sqrt(squares / (double(picture.width()) * picture.height())) / mean_of(expected, 0);
}

TEST(MirrorGather, AsksTheSameRaysEachTime) {
  const Patch patch;
  const std::vector<char> even{1, 1};
  const MirrorGather mirrors(patch.traced, even, patch.target, all_directions(8, 3));
  const std::vector<PrimaryRay> rays = mirrors.rays(), again = mirrors.rays();
  ASSERT_EQ(rays.size(), 64U * 8U);
  EXPECT_EQ(mirrors.size(), rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(rays[i].direction, again[i].direction);
    EXPECT_EQ(rays[i].origin, again[i].origin);
    EXPECT_GE(rays[i].direction.dot(rays[i].face), 0);
  }
}

TEST(MirrorGather, FindsTheLightOfAPatchSharedOrNot) {
  const Patch patch;
  const Gathered expected = truth(4096);
  double rough = 0;
  for (const char shares : {char(0), char(1)}) {
    const std::vector<char> even{1, shares};
    std::array<Moments, 4> means;
    Moments noises;
    for (std::uint64_t seed = 0; seed < 48; ++seed) {
      const MirrorGather mirrors(patch.traced, even, patch.target, all_directions(64, seed));
      const MirrorGather::Result found = mirrors.gather(patch.answers(mirrors.rays()));
      EXPECT_GT(found.lit, 0);
      EXPECT_EQ(found.shared, shares != 0 ? found.lit : 0);
      for (std::size_t k = 0; k < 4; ++k) {
        const FloatImage& light = found.light.directions[k].radiance;
        means[k].add(mean_of(light, 1));
        EXPECT_NEAR(mean_of(light, 0), 2 * mean_of(light, 1), 1e-4);
        EXPECT_EQ(mean_of(light, 2), 0);
      }
      noises.add(noise(found.light.directions[0].radiance, expected.directions[0].radiance));
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const double mean = mean_of(expected.directions[k].radiance, 0);
      EXPECT_NEAR(means[k].mean(), mean, 4 * means[k].error()) << "direction " << k;
      EXPECT_LT(means[k].error(), 0.01 * mean) << "else the bound says nothing";
    }
    if (shares == 0)
      rough = noises.mean();
    else
      EXPECT_LT(noises.mean(), 0.5 * rough) << "texels that share have less noise";
  }
}

TEST(MirrorGather, NoLightIsNone) {
  const Patch patch;
  const std::vector<char> even{1, 1};
  const MirrorGather mirrors(patch.traced, even, patch.target, all_directions(4));
  const MirrorGather::Result found = mirrors.gather(std::vector<Vec3>(mirrors.size(), Vec3(0)));
  EXPECT_EQ(found.lit, 0);
  EXPECT_EQ(mean_of(found.light.directions[0].radiance, 0), 0);
}

}  // namespace
}  // namespace rnmbake
