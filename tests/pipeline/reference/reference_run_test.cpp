#include "pipeline/reference/reference_run.h"

#include "base/files.h"
#include "blender/blender_session.h"
#include "encoding/basis_set.h"
#include "image/layered_exr.h"
#include "jobs/store.h"
#include "pipeline/traced_scene.h"
#include "process/stop.h"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

/// References of one scene, in a folder of their own.
class Tracing {
 public:
  explicit Tracing(ExportResult scene) : exported(std::move(scene)) {
    settings.output.dir = folder_.path();
    settings.output.depth = Depth::full;
    plan.blender_version = "4.3.2";
  }

  ReferenceOutcome run(const TraceCache& kept = {}) {
    const TraceScene scene(exported.diffuse_scene, plan.blender_version);
    return run_reference({scene, exported.list, bases_, {}, kept}, settings, plan);
  }

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] LayeredImage read(const std::string& name) const { return read_image(file(name)); }
  [[nodiscard]] nlohmann::json manifest() const {
    return nlohmann::json::parse(read_text(file("manifest.json")));
  }

  ExportResult exported;
  BakeSettings settings;
  ReferencePlan plan;

 private:
  TempFolder folder_;
  std::vector<BasisDirection> bases_ = flat_and_rnm().directions;
};

/// Mean of a layer, and the standard error of that from its texels' own.
struct Mean {
  double value = 0, error = 0;
};
Mean mean_of(const LayeredImage& image, const std::string& basis) {
  const FloatImage& values = image.find(basis == "flat" ? "" : basis)->pixels;
  const FloatImage& errors = image.find(basis + "_stderr")->pixels;
  Mean mean;
  for (std::size_t i = 0; i < values.data().size(); ++i) {
    mean.value += values.data()[i] / double(values.data().size());
    mean.error += std::pow(errors.data()[i] / double(errors.data().size()), 2);
  }
  mean.error = std::sqrt(mean.error);
  return mean;
}

TEST(ReferenceRun, WritesWhatTheSkyGives) {
  Tracing tracing(floor_under_sky());
  const ReferenceOutcome outcome = tracing.run();
  EXPECT_EQ(count_failed(outcome.deliveries), 0U);
  EXPECT_GT(outcome.rays, 0);
  const LayeredImage image = tracing.read("floor.exr");
  for (const BasisDirection& basis : flat_and_rnm().directions) {
    const Mean mean = mean_of(image, basis.name);
    const double truth = (1 + double(basis.direction.z)) / 2;
    // Colours share their paths, so three values count as one; four standard errors.
    EXPECT_NEAR(mean.value, truth, 4 * std::sqrt(3) * mean.error + 1e-5) << basis.name;
  }
  EXPECT_EQ(image.find("validity")->pixels.texel(3, 3)[0], 1);
  EXPECT_EQ(image.find("coverage")->pixels.texel(3, 3)[0], 1);
}

TEST(ReferenceRun, TheHeaderAndTheManifestSayWhatItIs) {
  Tracing tracing(floor_under_sky());
  tracing.plan.flat_normal_map = true;
  tracing.plan.faults.bump_shadowing = true;
  tracing.exported.diffuse_scene.outside = {{"object 'floor'", {"glossy"}}, {"world", {"volume"}}};
  (void)tracing.run();
  const LightmapMetadata metadata = read_metadata(tracing.read("floor.exr"), "floor.exr");
  EXPECT_EQ(metadata.recipe, "reference");
  EXPECT_EQ(metadata.model, "flat-normal-map");
  EXPECT_EQ(metadata.faults, "bump-shadowing");
  EXPECT_EQ(metadata.footprint, "half texel");
  EXPECT_EQ(metadata.samples, 16);
  EXPECT_EQ(metadata.bounces, -1);
  const nlohmann::json manifest = tracing.manifest();
  EXPECT_EQ(manifest.at("kind"), "reference");
  EXPECT_EQ(manifest.at("faults"), nlohmann::json({"bump-shadowing"}));
  EXPECT_EQ(manifest.at("outside_model").size(), 2U);
  const nlohmann::json& floor = manifest.at("objects").at(0);
  EXPECT_EQ(floor.at("paths"), 64 * 16);
  EXPECT_EQ(floor.at("outside_model"), nlohmann::json({"glossy"}));
  EXPECT_GT(floor.at("standard_error").get<double>(), 0);
}

TEST(ReferenceRun, OfABakeIsOne) {
  Tracing tracing(floor_under_sky());
  tracing.plan.is_bake = true;
  tracing.plan.bounces = 7;
  tracing.exported.diffuse_scene.outside = {{"object 'floor'", {"glossy"}}};
  (void)tracing.run();
  const LayeredImage image = tracing.read("floor.exr");
  const LightmapMetadata metadata = read_metadata(image, "floor.exr");
  EXPECT_EQ(metadata.engine, "embree");
  EXPECT_EQ(metadata.recipe, "traced");
  EXPECT_EQ(metadata.model, "");
  EXPECT_EQ(metadata.bounces, 7);
  EXPECT_EQ(image.find("validity"), nullptr);
  EXPECT_NE(image.find("rnm2_stderr"), nullptr);
  EXPECT_FALSE(image.attributes.contains("rnmbake:faults"));
  const nlohmann::json manifest = tracing.manifest();
  EXPECT_EQ(manifest.at("kind"), "bake");
  EXPECT_EQ(manifest.at("engine"), "embree");
  EXPECT_EQ(manifest.at("recipe"), "traced");
  EXPECT_FALSE(manifest.contains("model"));
  EXPECT_EQ(manifest.at("outside_model").at(0).at("owner"), "object 'floor'");
  EXPECT_EQ(manifest.at("objects").at(0).at("paths"), 64 * 16);

  tracing.settings.output.depth = Depth::half;
  (void)tracing.run();
  EXPECT_EQ(tracing.read("floor.exr").find("rnm2_stderr"), nullptr);
}

/// Rays of what is traced, none of what is kept.
class TracedBefore : public testing::Test {
 protected:
  TracedBefore() : tracing(floor_under_sky()) {}
  std::int64_t rays(const std::string& content = "scene", bool anew = false) {
    return tracing.run({&store, content, anew}).rays;
  }

  TempFolder folder;
  Store store{folder.path() / "cache", 0};
  Tracing tracing;
};

TEST_F(TracedBefore, IsNotTracedAgain) {
  const std::int64_t first = rays();
  EXPECT_GT(first, 0);
  const std::string before = read_text(tracing.file("floor.exr"));
  const auto manifest = tracing.manifest().at("objects").at(0);
  tracing.plan.threads = 1;
  EXPECT_EQ(rays(), 0);
  EXPECT_EQ(read_text(tracing.file("floor.exr")), before);
  EXPECT_EQ(tracing.manifest().at("objects").at(0), manifest);
  EXPECT_EQ(rays("scene", true), first);
  EXPECT_EQ(read_text(tracing.file("floor.exr")), before);
}

TEST_F(TracedBefore, IsTracedAnewWhereAnythingDiffers) {
  const std::int64_t first = rays();
  const std::vector<std::function<void()>> changes{
      [&] { tracing.exported.list.settings[0].samples = 32; },
      [&] { tracing.exported.list.settings[0].seed = 1; },
      [&] { tracing.exported.list.targets[0].width = 16; },
      [&] { tracing.exported.list.targets[0].flip_green = true; },
      [&] { tracing.exported.list.targets[0].key = "other"; },
      [&] { tracing.plan.bounces = 3; },
      [&] { tracing.plan.sh = 2; },
      [&] { tracing.plan.footprint = Footprint::centre; },
      [&] { tracing.plan.past_edge = PastEdge::mirror; },
      [&] { tracing.plan.error = 0.01; },
      [&] { tracing.plan.blender_version = "5.2.2"; },
      [&] { tracing.plan.faults.tilt_clamp = true; }};
  EXPECT_GT(first, 0);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i]();
    EXPECT_GT(rays(), 0) << i;
    EXPECT_EQ(rays(), 0) << i;
  }
  EXPECT_GT(rays("another scene"), 0);
}

TEST_F(TracedBefore, IsTakenWhateverIsTracedBesideIt) {
  add_object(tracing.exported.diffuse_scene, "shelf", {level(0.5F, 0.2F)}, Vec3(0.5F));
  const std::int64_t floor = rays();
  const std::string before = read_text(tracing.file("floor.exr"));
  add_target(tracing.exported, 1, 8);
  std::swap(tracing.exported.list.targets[0], tracing.exported.list.targets[1]);
  const std::int64_t shelf = rays();
  EXPECT_GT(shelf, 0);
  EXPECT_EQ(read_text(tracing.file("floor.exr")), before);
  EXPECT_EQ(rays("scene", true), floor + shelf);
}

TEST(ReferenceRun, OfABakeStopsAtEachObjectsNoise) {
  Tracing tracing(floor_under_sky());
  tracing.plan.is_bake = true;
  ObjectSettings& floor_settings = tracing.exported.list.settings.at(0);
  floor_settings.samples = 1 << 16;
  floor_settings.noise = 1;
  (void)tracing.run();
  const nlohmann::json manifest = tracing.manifest();
  const nlohmann::json& floor = manifest.at("objects").at(0);
  EXPECT_LE(floor.at("standard_error").get<double>(), 0.01);
  EXPECT_GT(floor.at("standard_error").get<double>(), 0.005);
  const int samples = floor.at("samples").get<int>();
  EXPECT_LT(samples, 1 << 16);
  EXPECT_NEAR(samples, floor.at("paths").get<double>() / 64, 0.5);
  EXPECT_EQ(read_metadata(tracing.read("floor.exr"), "floor.exr").samples, samples);
  EXPECT_FALSE(manifest.contains("error"));
}

TEST(ReferenceRun, WhatTheRecipeBakesBlackIsDeliveredBlack) {
  ExportResult scene = floor_under_sky();
  scene.diffuse_scene.materials[0].albedo = Vec3(0);
  Tracing tracing(std::move(scene));
  tracing.plan.flat_normal_map = true;
  tracing.plan.faults.no_diffuse = true;
  const ReferenceOutcome outcome = tracing.run();
  EXPECT_EQ(count_failed(outcome.deliveries), 0U);
  const LayeredImage image = tracing.read("floor.exr");
  EXPECT_EQ(image.find("coverage")->pixels.texel(3, 3)[0], 1);
  for (const float value : image.find("rnm0")->pixels.data()) EXPECT_EQ(value, 0);
}

// A sun from +y: with Y up rnm1 (y > 0) sees it and rnm2 hardly; with Y down it is the other way round.
TEST(ReferenceRun, GreenDownMirrorsTheBasesAndTheHarmonics) {
  ExportResult scene = floor_under_sky(0);
  LightInfo sun = light("SUN", 1, {{"angle", 0.0}});
  const float s = std::sqrt(0.5F);
  sun.to_world = Mat44(1, 0, 0, 0, 0, s, -s, 0, 0, s, s, 0, 0, 0, 0, 1);  // +z of the lamp looks to (0, s, s)
  scene.diffuse_scene.survey.lights.push_back(sun);
  add_object(scene.diffuse_scene, "down", {level(1, 0, true, Vec3(5, 0, 0))}, Vec3(0.5F));
  add_target(scene, 1, 8);
  scene.list.targets[1].flip_green = true;
  Tracing tracing(std::move(scene));
  tracing.plan.sh = 3;
  (void)tracing.run();
  const LayeredImage up = tracing.read("floor.exr"), down = tracing.read("down.exr");
  const auto value = [](const LayeredImage& image, const char* name) {
    return image.find(name)->pixels.texel(4, 4)[0];
  };
  EXPECT_GT(value(up, "rnm1"), value(up, "rnm2") + 0.1F);
  EXPECT_FLOAT_EQ(value(down, "rnm1"), value(up, "rnm2"));
  EXPECT_FLOAT_EQ(value(down, "rnm2"), value(up, "rnm1"));
  EXPECT_EQ(read_metadata(down, "down.exr").green, Green::y_down);
  EXPECT_GT(value(up, "sh1"), 0);
  for (const char* odd : {"sh1", "sh4", "sh5"}) EXPECT_FLOAT_EQ(value(down, odd), -value(up, odd)) << odd;
  for (const char* even : {"sh0", "sh2", "sh3", "sh6", "sh7", "sh8"})
    EXPECT_FLOAT_EQ(value(down, even), value(up, even)) << even;
}

TEST(ReferenceRun, AnObjectWithoutATexelFailsAlone) {
  ExportResult scene = floor_under_sky();
  add_object(scene.diffuse_scene, "speck", {level(1, 1)}, Vec3(0.5F));
  for (Vec2& uv : scene.diffuse_scene.survey.meshes[1].uv_layers[0].uv) uv *= 0.001F;
  add_target(scene, 1, 8);
  Tracing tracing(std::move(scene));
  const ReferenceOutcome outcome = tracing.run();
  EXPECT_EQ(count_failed(outcome.deliveries), 1U);
  EXPECT_TRUE(std::filesystem::exists(tracing.file("floor.exr")));
  const nlohmann::json speck = tracing.manifest().at("objects").at(1);
  EXPECT_EQ(speck.at("status"), "failed");
  EXPECT_NE(speck.at("error").get<std::string>().find("'speck'"), std::string::npos);
}

TEST(ReferenceRun, AStopIsPassedOnAndLeavesNoManifest) {
  Tracing tracing(floor_under_sky());
  StopRequest::request(SIGINT);
  EXPECT_THROW((void)tracing.run(), Interrupted);
  StopRequest::reset();
  EXPECT_FALSE(std::filesystem::exists(tracing.file("manifest.json")));
}

TEST(ReferenceRun, LayersMayLieInFilesOfTheirOwn) {
  Tracing tracing(floor_under_sky());
  tracing.settings.output.layout = OutputSettings::Layout::files;
  const ReferenceOutcome outcome = tracing.run();
  const auto& files = std::get<Delivered>(*outcome.deliveries.front()).files;
  EXPECT_EQ(files.size(), 4U + 4U + 2U);
  EXPECT_TRUE(std::filesystem::exists(tracing.file("floor.rnm2_stderr.exr")));
  EXPECT_TRUE(std::filesystem::exists(tracing.file("floor.validity.exr")));
}

TEST(ReferenceRun, FramesAreThoseOfTheSurface) {
  Tracing tracing(floor_under_sky());
  tracing.settings.output.frames = true;
  (void)tracing.run();
  const LayeredImage image = tracing.read("floor.exr");
  EXPECT_EQ(image.find("normal")->pixels.texel(2, 2)[2], 1);
  EXPECT_EQ(image.find("tangent")->pixels.texel(2, 2)[0], 1);
}

}  // namespace
}  // namespace rnmbake
