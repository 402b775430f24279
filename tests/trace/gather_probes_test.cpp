// Probes: closed forms at points that light reaches from all around.
#include "trace/probes/gather_probes.h"

#include "encoding/sh.h"
#include "sampling/octahedral.h"
#include "trace/probes/surroundings.h"
#include "trace/trace_scenes.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const std::vector<Vec3> axes{Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0),       Vec3(0, -1, 0),
                             Vec3(0, 0, 1), Vec3(0, 0, -1), unit(Vec3(1, 2, 2)), unit(Vec3(-2, 1, -2))};

ProbeGatherOptions options_of(int samples) {
  ProbeGatherOptions options;
  options.directions = axes;
  options.samples = samples;
  return options;
}

void expect_near(const GatheredProbe& probe, std::size_t k, double truth, double systematic = 1e-5) {
  EXPECT_NEAR(double(probe.irradiance[k].y), truth, 4.5 * double(probe.standard_error[k].y) + systematic)
      << "direction " << k;
}

/// Under a sky of radiance 1, over a plane of albedo a: E/pi = (1 + z) / 2 + a (1 - z) / 2.
TEST(GatherProbes, OverAPlaneUnderAConstantSky) {
  constexpr float albedo = 0.6F, half = 1e4F;
  DiffuseScene scene;
  add_object(scene, "plane", {level(half, 0)}, Vec3(albedo));
  scene.world.radiance = Vec3(1);
  const TraceScene traced(scene, "4.3.2");
  const std::vector<Vec3> positions{Vec3(0, 0, 1), Vec3(1, 0, 2), Vec3(2, 0, 1)};
  for (const GatheredProbe& probe : gather_probes(traced, positions, options_of(16384))) {
    EXPECT_EQ(probe.back_faces, 0);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const double z = double(axes[k].z);
      EXPECT_LT(probe.standard_error[k].y, 5e-3) << "the test is too weak";
      expect_near(probe, k, (1 + z) / 2 + double{albedo} * (1 - z) / 2, 2 / double{half});
    }
    const auto basis = sh_irradiance_basis(axes[6]);
    Vec3 decoded(0);
    for (std::size_t c = 0; c < 9; ++c) decoded += probe.harmonics[c] * basis[c];
    const double z = double(axes[6].z);
    EXPECT_NEAR(decoded.y, (1 + z) / 2 + double{albedo} * (1 - z) / 2, 0.02);
  }
}

/// A sun of irradiance 1 over a plane of albedo a: directly max(0, D.b) / pi, and from below what the plane
/// reflects, a cos / pi of radiance over the lower half.
TEST(GatherProbes, PartsOfASunsLight) {
  constexpr double albedo = 0.5, half = 1e4;
  DiffuseScene scene;
  add_object(scene, "plane", {level(float(half), 0)}, Vec3(float(albedo)));
  scene.survey.lights.push_back(light("SUN", 1, {{"angle", 0}}));
  const TraceScene traced(scene, "4.3.2");
  const std::vector<Vec3> positions{Vec3(0, 0, 1)};
  for (const bool lamps : {true, false}) {
    for (const bool glow : {true, false}) {
      ProbeGatherOptions options = options_of(1024);
      options.direct = {lamps, glow};
      const GatheredProbe probe = gather_probes(traced, positions, options).front();
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const double z = double(axes[k].z), direct = lamps ? std::max(0.0, z) / pi : 0;
        expect_near(probe, k, direct + albedo / pi * (1 - z) / 2, 2 / half);
      }
    }
  }
}

/// What glows and the sky reach a probe directly, and no more than that where nothing reflects.
TEST(GatherProbes, GlowCanBeLeftOut) {
  DiffuseScene scene;
  add_object(scene, "lamp", {level(1, 2, false)}, Vec3(0), Vec3(3));
  scene.world.radiance = Vec3(1);
  const TraceScene traced(scene, "4.3.2");
  const std::vector<Vec3> positions{Vec3(Vec3d(0, 0, 1) - traced.origin())};
  ProbeGatherOptions options = options_of(1024);
  const GatheredProbe whole = gather_probes(traced, positions, options).front();
  // The form factor of the lamp, half size 1 at height 1: 1.74083950 / pi.
  expect_near(whole, 4, 1 + 2 * 1.74083950 / pi);
  options.direct.lamps = false;
  const GatheredProbe glow = gather_probes(traced, positions, options).front();
  expect_near(glow, 4, 1 + 2 * 1.74083950 / pi);
  options.direct.glow = false;
  const GatheredProbe bounced = gather_probes(traced, positions, options).front();
  for (const Vec3& light : bounced.irradiance) EXPECT_EQ(light, Vec3(0));
}

TEST(GatherProbes, SameAtAnyNumberOfThreads) {
  DiffuseScene scene;
  add_object(scene, "room", room(2), Vec3(0.5F), Vec3(0.1F));
  const TraceScene traced(scene, "4.3.2");
  std::vector<Vec3> positions;
  for (int i = 0; i < 50; ++i) positions.emplace_back(-1.5F + 0.06F * float(i), 0.2F, -0.3F);
  ProbeGatherOptions options = options_of(32);
  options.threads = 1;
  const auto one = gather_probes(traced, positions, options);
  options.threads = 2;
  const auto two = gather_probes(traced, positions, options);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_EQ(one[i].irradiance, two[i].irradiance);
    EXPECT_EQ(one[i].harmonics, two[i].harmonics);
  }
}

TEST(Octahedral, ThereAndBack) {
  std::mt19937 random(1);
  std::normal_distribution<float> number;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 direction = unit(Vec3(number(random), number(random), number(random)));
    const Vec2 place = octahedral(direction);
    EXPECT_LE(std::max(std::abs(place.x), std::abs(place.y)), 1);
    EXPECT_LT((octahedral_direction(place) - direction).length(), 1e-6F);
  }
}

TEST(LookAround, InsideAndOutsideOfARoom) {
  DiffuseScene scene;
  add_object(scene, "room", room(2), Vec3(0.5F));  // its walls face inwards
  const TraceScene traced(scene, "4.3.2");
  const auto found =
      look_around(traced, std::vector<Vec3>{Vec3(0, 0, 0), Vec3(0, 0, -1.5F), Vec3(2.5F, 0, 0)}, {});
  EXPECT_EQ(found[0].back_faces, 0);
  EXPECT_NEAR(found[0].nearest, 2, 0.02);
  EXPECT_NEAR(found[1].nearest, 0.5, 0.02);
  EXPECT_GT(found[2].back_faces, 0.3);
  EXPECT_NEAR(found[2].way_out_distance, 0.5, 0.02);
  EXPECT_LT(found[2].way_out.x, -0.99F);
  // Straight down from the middle is 2; the texels around that are a little more.
  const auto at = [](const Vec3& direction) {
    const Vec2 p = octahedral(direction);
    const auto texel = [](float x) { return std::size_t(std::clamp(int((x + 1) * 8), 0, 15)); };
    return texel(p.y) * 16 + texel(p.x);
  };
  EXPECT_NEAR(found[0].mean[at(unit(Vec3(0.05F, 0.05F, 1)))], 2, 0.1);
  EXPECT_NEAR(found[0].mean[at(unit(Vec3(1, 0.05F, 0.05F)))], 2, 0.1);
  EXPECT_GT(found[0].mean[at(unit(Vec3(1, 1, 1)))], 3);
}

}  // namespace
}  // namespace rnmbake
