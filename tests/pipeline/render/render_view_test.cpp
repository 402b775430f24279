#include "pipeline/render/render_view.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/basis_set.h"
#include "encoding/rnm.h"
#include "pipeline/reference/reference_run.h"
#include "pipeline/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr const char* version = "4.3.2";

/// A scene, its references as lightmaps, and its camera's view lit by these.
class Studio {
 public:
  explicit Studio(ExportResult scene) : exported(std::move(scene)), traced_(exported.diffuse_scene, version) {
    if (!exported.diffuse_scene.camera) exported.diffuse_scene.camera = from_above();
  }

  static Camera from_above() {
    Camera camera;
    camera.name = "camera";
    camera.to_world.setTranslation(Vec3d(0, 0, 1));
    camera.angle_x = camera.angle_y = 2 * std::atan(0.9);  // all but the rim of a square of 2 units
    camera.resolution_x = camera.resolution_y = 12;
    return camera;
  }

  void bake() {
    BakeSettings settings;
    settings.output.dir = folder.path();
    settings.output.depth = Depth::full;
    ReferencePlan plan;
    plan.blender_version = version;
    const auto bases = flat_and_rnm().directions;
    const ReferenceOutcome outcome = run_reference({traced_, exported.list, bases}, settings, plan);
    ASSERT_EQ(count_failed(outcome.deliveries), 0U);
  }

  [[nodiscard]] SceneLightmaps lightmaps() const { return {folder.path(), exported.diffuse_scene}; }

  [[nodiscard]] View view(const std::string& lighting, int samples = 4) const {
    RenderOptions options;
    options.view.width = options.view.height = 12;
    options.view.samples = samples;
    const Lighting how = *lighting_of(lighting);
    if (how.kind != Lighting::Kind::decoded) return render_view(traced_, {}, how, options);
    const SceneLightmaps maps = lightmaps();
    return render_view(traced_, {&maps, nullptr}, how, options);
  }

  ExportResult exported;
  TempFolder folder;

 private:
  TraceScene traced_;
};

struct ViewMean {
  double value = 0, error = 0;  // standard error, from how the values scatter
};
ViewMean mean_of(const FloatImage& image) {
  const auto count = double(image.texels());
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < image.texels(); ++i) sum += image.data()[3 * i];
  for (std::size_t i = 0; i < image.texels(); ++i) squares += std::pow(image.data()[3 * i] - sum / count, 2);
  return {sum / count, std::sqrt(squares / count / (count - 1))};
}

/// Largest standard error among the texels: no mean of them, however weighted, is noisier.
double noisiest(const FloatImage& errors) {
  return *std::ranges::max_element(errors.data());
}

void expect_everywhere(const FloatImage& picture, double value) {
  for (const float one : picture.data()) ASSERT_NEAR(one, value, 2e-5 * (1 + value));
}

/// A floor whose normal map is the same vector everywhere, under one sun.
ExportResult tilted_floor(const Vec3& normal, double sun_angle, bool mirrored_in_x = false) {
  ExportResult exported = floor_under_sky(0);
  DiffuseScene& scene = exported.diffuse_scene;
  scene.pictures.push_back({1, 1, {(normal + Vec3(1)) * 0.5F}, "normals"});
  scene.normal_maps.push_back({0, "Lightmap", 1});
  scene.materials[0].normal_map = 0;
  LightInfo sun = light("SUN", 1, {{"angle", 0}});
  sun.to_world.setAxisAngle(Vec3d(0, 1, 0), sun_angle);  // it shines along -z of its own axes
  scene.survey.lights.push_back(sun);
  if (mirrored_in_x) scene.survey.objects[0].to_world.setScale(Vec3d(-1, 1, 1));
  return exported;
}

constexpr double sun_angle = 0.5;
const Vec3 to_sun(static_cast<float>(std::sin(sun_angle)), 0, static_cast<float>(std::cos(sun_angle)));

TEST(RenderView, UnderASkySingleTruthAndAlbedoAreOne) {
  Studio studio(floor_under_sky());
  studio.bake();
  const double noise = noisiest(read_image(studio.folder.path() / "floor.exr").find("flat_stderr")->pixels);
  EXPECT_NEAR(mean_of(studio.view("single").beauty).value, 0.5, 4 * 0.5 * noise + 1e-6);
  EXPECT_NEAR(mean_of(studio.view("vrad").beauty).value, 0.5, 4 * 0.5 * noise + 1e-6);
  const ViewMean truth = mean_of(studio.view("truth", 64).beauty);
  EXPECT_NEAR(truth.value, 0.5, 4 * truth.error + 1e-6);
  expect_everywhere(studio.view("none").beauty, 0.5);
}

TEST(RenderView, ATiltedNormalUnderASunIsTheCosineInTruth) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0.6F, 0, 0.8F), Vec3(-0.36F, 0.48F, 0.8F)}) {
    const Studio studio(tilted_floor(normal, sun_angle));
    expect_everywhere(studio.view("truth").beauty, 0.5 * double(normal.dot(to_sun)) / pi);
  }
}

TEST(RenderView, DecodesFollowTheirFormulas) {
  const Vec3 normal(0.6F, 0, 0.8F);
  Studio studio(tilted_floor(normal, sun_angle));
  studio.bake();
  std::array<float, 3> maps{};
  for (std::size_t i = 0; i < 3; ++i)
    maps[i] = std::max(0.0F, rnm_basis()[i].dot(to_sun)) / static_cast<float>(pi);
  const float flat = to_sun.z / static_cast<float>(pi);
  expect_everywhere(studio.view("single").beauty, 0.5F * flat);
  expect_everywhere(studio.view("squared").beauty, 0.5F * rnm_decode_squared(maps, normal));
  expect_everywhere(studio.view("linear").beauty, 0.5F * rnm_decode_linear(maps, normal));
  expect_everywhere(studio.view("vrad").beauty,
                    0.5F * rnm_decode_squared(rnm_scaled_to_flat(maps, flat), normal));
}

// The object's x runs the other way: so does the tangent, and with it what the normal map means.
TEST(RenderView, AMirroredObjectHasAMirroredTangent) {
  const Vec3 normal(0.6F, 0, 0.8F), turned(-0.6F, 0, 0.8F);
  Studio studio(tilted_floor(normal, sun_angle, true));
  expect_everywhere(studio.view("truth").beauty, 0.5 * double(turned.dot(to_sun)) / pi);
  studio.bake();
  std::array<float, 3> maps{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 b = rnm_basis()[i];
    maps[i] = std::max(0.0F, Vec3(-b.x, b.y, b.z).dot(to_sun)) / static_cast<float>(pi);
  }
  expect_everywhere(studio.view("squared").beauty, 0.5F * rnm_decode_squared(maps, normal));
}

TEST(RenderView, AHalfStrongNormalMapBendsLess) {
  ExportResult scene = tilted_floor({0.6F, 0, 0.8F}, sun_angle);
  scene.diffuse_scene.normal_maps[0].strength = 0.5F;
  const Vec3 bent = Vec3(0.3F, 0, 0.9F).normalized();
  expect_everywhere(Studio(std::move(scene)).view("truth").beauty, 0.5 * double(bent.dot(to_sun)) / pi);
}

TEST(RenderView, EmissionIsAddedToEveryKindOfLight) {
  ExportResult scene = floor_under_sky(0);
  scene.diffuse_scene.materials[0].emission = Vec3(3);
  Studio studio(std::move(scene));
  studio.bake();
  for (const char* lighting : {"truth", "single", "squared"})
    expect_everywhere(studio.view(lighting).beauty, 3);
  expect_everywhere(studio.view("none").beauty, 3.5);
}

TEST(RenderView, WhatHasNoLightmapIsTracedAndNamed) {
  ExportResult scene = tilted_floor({0.6F, 0, 0.8F}, sun_angle);
  add_object(scene.diffuse_scene, "table", {level(0.2F, 0.1F)}, Vec3(0.25F));
  for (SceneObject& object : scene.diffuse_scene.survey.objects) object.visible_to_camera = true;
  Studio studio(std::move(scene));
  studio.bake();
  EXPECT_EQ(studio.lightmaps().bare(), std::vector<std::string>{"table"});
  const View view = studio.view("single");
  EXPECT_NEAR(view.beauty.texel(6, 6)[0], 0.25 * double(to_sun.z) / pi, 1e-5);
  EXPECT_NEAR(view.beauty.texel(1, 1)[0], 0.5 * double(to_sun.z) / pi, 1e-5);
}

/// The code of the Error that the lightmaps give on a scene; ok: none.
ExitCode refusal(const std::filesystem::path& lightmaps, const DiffuseScene& scene) {
  try {
    (void)SceneLightmaps(lightmaps, scene);
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::ok;
}

TEST(RenderView, LightmapsOfAnotherSceneAreRefused) {
  Studio studio(tilted_floor({0, 0, 1}, 0));
  studio.bake();
  EXPECT_EQ(refusal(studio.folder.path(), studio.exported.diffuse_scene), ExitCode::ok);

  DiffuseScene renamed = studio.exported.diffuse_scene;
  renamed.survey.objects[0].key = "ceiling";
  EXPECT_EQ(refusal(studio.folder.path(), renamed), ExitCode::invalid_input);

  DiffuseScene other_layer = studio.exported.diffuse_scene;
  other_layer.survey.meshes[0].uv_layers[0].name = "UVMap";
  EXPECT_EQ(refusal(studio.folder.path(), other_layer), ExitCode::invalid_input);
}

TEST(RenderView, LightmapsWhoseChartsLieElsewhereAreRefused) {
  ExportResult scene = tilted_floor({0, 0, 1}, 0);
  auto& uv = scene.diffuse_scene.survey.meshes[0].uv_layers[0].uv;
  for (Vec2& one : uv) one *= 0.4F;
  scene.list.targets[0].uv = std::make_shared<const std::vector<Vec2>>(uv);
  Studio studio(std::move(scene));
  studio.bake();
  EXPECT_EQ(refusal(studio.folder.path(), studio.exported.diffuse_scene), ExitCode::ok);
  DiffuseScene moved = studio.exported.diffuse_scene;
  for (Vec2& one : moved.survey.meshes[0].uv_layers[0].uv) one += Vec2(0.55F);
  EXPECT_EQ(refusal(studio.folder.path(), moved), ExitCode::invalid_input);
}

TEST(RenderView, WithoutACameraThereIsNoView) {
  const ExportResult scene = floor_under_sky();
  EXPECT_THROW((void)camera_of(scene.diffuse_scene), Error);
}

}  // namespace
}  // namespace rnmbake
