#include "trace/gather.h"

#include "support/chance.h"
#include "trace/moments.h"
#include "trace/trace_scenes.h"

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Distance from the truth in standard errors, one for each direction (green channel, mean of the map).
std::vector<double> deviations(const Gathered& gathered, const std::vector<double>& truth) {
  std::vector<double> z;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const GatheredDirection& it = gathered.directions[k];
    z.push_back((it.mean[1] - truth[k]) / it.mean_error[1]);
  }
  return z;
}

/// The relative error, mean over the directions and seeds, must be within 4 of its standard errors, and
/// these at most `weakest` (2.5e-4: a bias of 0.1 % fails); each direction must be within 4.5 of its own; and
/// the errors that each run states must be those that the seeds show.
void expect_unbiased(const DiffuseScene& scene, std::size_t object, const GatherOptions& base,
                     const std::vector<double>& truth, double weakest = 6e-4, int seeds = 32) {
  const std::size_t count = truth.size();
  std::vector<Moments> each(count);
  std::vector<double> stated(count);
  Moments all;
  for (int seed = 0; seed < seeds; ++seed) {
    GatherOptions options = base;
    options.seed = static_cast<std::uint64_t>(seed);
    const Gathered gathered = gather_one(scene, object, options);
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double off = gathered.directions[k].mean[1] / truth[k] - 1;
      each[k].add(off);
      stated[k] += std::pow(gathered.directions[k].mean_error[1] / truth[k], 2);
      sum += off;
    }
    all.add(sum / double(count));
  }
  EXPECT_LT(all.error(), weakest) << "the test is too weak";
  EXPECT_LT(std::abs(all.mean()), 4 * all.error() + 1e-5);
  for (std::size_t k = 0; k < count; ++k) {
    SCOPED_TRACE(base.directions[k].name);
    EXPECT_LT(std::abs(each[k].mean()), 4.5 * each[k].error() + 1e-5);
    if (each[k].spread() < 1e-5) continue;  // no noise
    const double ratio = std::sqrt(stated[k] / seeds) / each[k].spread();
    EXPECT_GT(ratio, 0.5) << "stated errors are too small";
    EXPECT_LT(ratio, 2) << "stated errors are too large";
  }
}

DiffuseScene furnace(float half = 1, const Vec3& middle = Vec3(0), float emission = 1, float albedo = 0.5F) {
  DiffuseScene scene;
  add_object(scene, "room", room(half, middle), Vec3(albedo), Vec3(emission));
  return scene;
}

TEST(Gather, UniformSkyGivesEveryTexelItsShare) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
  scene.world.radiance = Vec3(1);
  expect_unbiased(scene, 0, all_directions(512), {1, sky_share, sky_share, sky_share}, 2.5e-4);
}

/// Radiance 2 everywhere.
const std::vector<double> furnace_truth{2, 2 * sky_share, 2 * sky_share, 2 * sky_share};

TEST(Gather, Furnace) {
  expect_unbiased(furnace(), 0, all_directions(1536), furnace_truth, 2.5e-4);
}

TEST(Gather, FurnaceWithoutSharing) {
  GatherOptions options = all_directions(512);
  options.reuse = false;
  expect_unbiased(furnace(), 0, options, furnace_truth);
}

TEST(Gather, FurnaceByChanceAlone) {
  GatherOptions options = all_directions(1024);
  options.sample_lights = false;
  expect_unbiased(furnace(), 0, options, furnace_truth);
}

TEST(Gather, FurnaceOfHighAlbedoLosesNoEnergy) {
  expect_unbiased(furnace(1, Vec3(0), 0.5F, 0.75F), 0, all_directions(384), furnace_truth, 1e-3);
}

TEST(Gather, LightSamplingAloneAgrees) {
  DiffuseScene scene;  // a lamp that is not too near: light sampling alone has infinite variance in the
                       // furnace's corners
  add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
  add_object(scene, "lamp", {level(1, 1, false)}, Vec3(0), Vec3(1));
  GatherOptions options = all_directions(64);
  options.footprint = Footprint::centre;
  const Gathered both = gather_one(scene, 0, options, 5, 5);
  options.sample_bsdf = false;
  options.samples = 1024;
  const Gathered sampled = gather_one(scene, 0, options, 5, 5);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& a = both.directions[k];
    const auto& b = sampled.directions[k];
    EXPECT_LT(std::abs(a.mean[0] - b.mean[0]), 4 * std::hypot(a.mean_error[0], b.mean_error[0]));
  }
}

TEST(Gather, SquareLampMatchesLambertsPolygonFormula) {
  DiffuseScene scene;  // the middle texel of 5 x 5 lies under the middle of the lamp
  add_object(scene, "floor", {level(0.05F, 0)}, Vec3(0));
  add_object(scene, "lamp", {level(1, 1, false)}, Vec3(0), Vec3(1));
  GatherOptions options = all_directions(1 << 14);
  options.footprint = Footprint::centre;
  const Gathered gathered = gather_one(scene, 0, options, 5, 5);
  const std::vector<double> truth{1.74083950 / pi, 1.02119225 / pi, 1.02492043 / pi, 1.02492043 / pi};
  for (std::size_t k = 0; k < 4; ++k) {
    const double value = gathered.directions[k].radiance.texel(2, 2)[0];
    const double error = gathered.directions[k].standard_error.texel(2, 2)[0];
    EXPECT_LT(error, 3e-3 * truth[k]);
    EXPECT_LT(std::abs(value - truth[k]), 4 * error + 1e-5) << k;
  }
}

TEST(Gather, FurnaceFarFromTheOriginAndTiny) {
  expect_unbiased(furnace(1, Vec3(1000, -700, 300)), 0, all_directions(256), furnace_truth, 8e-4);
  expect_unbiased(furnace(0.01F, Vec3(0.3F, 0, 0)), 0, all_directions(256), furnace_truth, 8e-4);
}

TEST(Gather, NoLightGivesExactZeros) {
  DiffuseScene scene;
  add_object(scene, "room", room(1), Vec3(0.8F));
  const Gathered gathered = gather_one(scene, 0, all_directions(8));
  for (const GatheredDirection& direction : gathered.directions) {
    for (const float value : direction.radiance.data()) EXPECT_EQ(value, 0);
    for (const float value : direction.standard_error.data()) EXPECT_EQ(value, 0);
  }
}

TEST(Gather, LampInAClosedBoxStaysInside) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(2, 0)}, Vec3(0.8F));
  add_object(scene, "box", room(0.5F, Vec3(0, 0, 1)), Vec3(0.8F));
  LightInfo lamp = light("POINT", 100, {{"shadow_soft_size", 0.1}});
  lamp.to_world[3][2] = 1;
  scene.survey.lights.push_back(lamp);
  const Gathered outside = gather_one(scene, 0, all_directions(64));
  for (const float value : outside.directions[0].radiance.data()) EXPECT_EQ(value, 0);
  EXPECT_GT(gather_one(scene, 1, all_directions(16)).directions[0].mean[0], 0.1);
}

TEST(Gather, IsTheSameForASeedAtAnyNumberOfThreads) {
  GatherOptions options = all_directions(8, 7);
  options.threads = 1;
  const Gathered one = gather_one(furnace(), 0, options);
  options.threads = 2;
  const Gathered two = gather_one(furnace(), 0, options);
  options.seed = 8;
  const Gathered other = gather_one(furnace(), 0, options);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(one.directions[k].radiance.data(), two.directions[k].radiance.data());
    EXPECT_EQ(one.directions[k].standard_error.data(), two.directions[k].standard_error.data());
    EXPECT_NE(one.directions[k].radiance.data(), other.directions[k].radiance.data());
  }
}

TEST(Gather, BouncesCountSurfacesAfterTheTexelsOwn) {
  for (const int bounces : {0, 1, 2}) {
    GatherOptions options = all_directions(256);
    options.bounces = bounces;
    double truth = 0;  // e (1 + r + r^2 + ...), the last for light that bounced so often
    for (int i = 0; i <= bounces; ++i) truth += std::pow(0.5, i);
    expect_unbiased(furnace(), 0, options, {truth, truth * sky_share, truth * sky_share, truth * sky_share});
  }
}

/// A closed room gets back r of what it got: with k bounces its walls have 1 + r + ... + r^k on average.
TEST(Gather, LampsLightNoMoreBouncesThanTheirOwn) {
  for (const int most : {0, 2, 1024}) {
    DiffuseScene scene = furnace(1, Vec3(0), 0, 0.8F);
    scene.survey.lights.push_back(light("POINT", 24 * pi, {{"shadow_soft_size", 0}}));
    scene.survey.lights.back().max_bounces = most;
    const Gathered gathered = gather_one(scene, 0, all_directions(256), 48, 8);
    const GatheredDirection& flat = gathered.directions[0];
    const double truth = (1 - std::pow(0.8, most + 1)) / (1 - 0.8);
    EXPECT_LT(flat.mean_error[1], 0.003 * truth) << "the test is too weak";
    // Texels across the diagonal of a wall count one of its triangles alone: one in eight, by some percent.
    EXPECT_LT(std::abs(flat.mean[1] - truth), 4.5 * flat.mean_error[1] + 1e-3 * truth) << most;
  }
}

TEST(Gather, NegativeLightTakesAwayWhatPositiveLightGives) {
  const auto floor = [](float emission) {
    DiffuseScene scene;
    scene.world.radiance = Vec3(1);
    add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
    add_object(scene, "panel", {level(1, 1, false)}, Vec3(0), Vec3(emission));
    return gather_one(scene, 0, all_directions(512));
  };
  const Gathered sink = floor(-0.5F), none = floor(0), lamp = floor(0.5F);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [low, middle, high] = std::tie(sink.directions[k], none.directions[k], lamp.directions[k]);
    const double error = std::hypot(low.mean_error[1], high.mean_error[1], 2 * middle.mean_error[1]);
    EXPECT_GT(high.mean[1] - low.mean[1], 20 * error) << "the test is too weak";
    EXPECT_LT(std::abs(low.mean[1] + high.mean[1] - 2 * middle.mean[1]), 4.5 * error);
  }
}

/// Each seed is one trial: its texels share paths. The error of a mean comes from 16 batches or more, so that
/// its distance from the truth follows Student's t of 15 degrees of freedom or more.
TEST(Gather, ErrorAskedForIsReachedAndTrue) {
  const DiffuseScene scene = furnace();
  GatherOptions options = all_directions(1 << 14);
  options.error = 0.1;
  constexpr double normal_95 = 1.959964;  // the normal distribution's
  int inside = 0;
  double reached = 0;  // of the squared error asked for
  const int seeds = 500;
  for (int seed = 0; seed < seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const Gathered gathered = gather_one(scene, 0, options, 12, 2);
    double worst = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const GatheredDirection& it = gathered.directions[k];
      double squares = 0;
      for (const float error : it.standard_error.data()) squares += double(error) * error;
      worst = std::max(worst, std::sqrt(squares / double(it.standard_error.data().size())) / it.mean[0]);
    }
    EXPECT_LE(worst, options.error);
    reached += std::pow(worst / options.error, 2);
    inside += std::abs(deviations(gathered, furnace_truth)[0]) < normal_95 ? 1 : 0;
  }
  const CountBounds right = count_bounds(seeds, student_within(normal_95, 15), 0.95);
  EXPECT_GE(inside, right.fewest);
  EXPECT_LE(inside, right.most);
  EXPECT_GT(reached / seeds, 0.5) << "it took more than twice the samples that the error needs";
}

TEST(Gather, ValidityFindsTexelsBehindWalls) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(2, 0)}, Vec3(0.8F));
  std::vector<Quad> outside;  // a box on the floor that faces outwards: its inside shows back faces
  for (Quad quad : room(1, Vec3(0, 0, 0.5F))) outside.push_back({quad[3], quad[2], quad[1], quad[0]});
  add_object(scene, "box", outside, Vec3(0.8F));
  const Gathered gathered = gather_one(scene, 0, all_directions(16));
  EXPECT_EQ(gathered.validity.texel(4, 4)[0], 0);
  EXPECT_EQ(gathered.validity.texel(0, 0)[0], 1);
  EXPECT_EQ(gathered.coverage.texel(0, 0)[0], 1);
}

TEST(Gather, ShOfAUniformSky) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
  scene.world.radiance = Vec3(1);
  GatherOptions options = all_directions(1 << 9);
  options.sh_order = 3;
  std::array<Moments, 9> found;  // of one texel: seeds are independent, texels are not
  for (options.seed = 0; options.seed < 32; ++options.seed) {
    const Gathered gathered = gather_one(scene, 0, options, 4, 4);
    ASSERT_EQ(gathered.sh.size(), found.size());
    for (std::size_t c = 0; c < found.size(); ++c) found[c].add(gathered.sh[c].texel(1, 2)[1]);
  }
  // Integrals of Y over the upper hemisphere.
  const std::array<double, 9> truth{std::sqrt(pi), 0, std::sqrt(3 * pi) / 2, 0, 0, 0, 0, 0, 0};
  for (std::size_t c = 0; c < found.size(); ++c) {
    EXPECT_LT(found[c].error(), 0.003) << "the test is too weak";
    EXPECT_NEAR(found[c].mean(), truth[c], 4.5 * found[c].error() + 1e-5) << c;
  }
}

}  // namespace
}  // namespace rnmbake
