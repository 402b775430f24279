#include "pipeline/render/render_gbuffer.h"

#include "base/error.h"
#include "base/files.h"
#include "pipeline/traced_scene.h"

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A floor whose normal map is one vector, seen by a camera that looks along +y from a unit above it and is
/// turned down by 45 degrees.
DiffuseScene tilted_floor(const Vec3& normal) {
  DiffuseScene scene = floor_under_sky().diffuse_scene;
  scene.pictures.push_back({1, 1, {(normal + Vec3(1)) * 0.5F}, "normals"});
  scene.normal_maps.push_back({0, "Lightmap", 1});
  scene.materials[0].normal_map = 0;
  Camera camera;
  camera.to_world = Mat44().setAxisAngle(Vec3d(1, 0, 0), pi / 4) * Mat44().setTranslation(Vec3d(0, -1, 1));
  camera.angle_x = camera.angle_y = 0.5;
  camera.resolution_x = camera.resolution_y = 6;
  scene.camera = camera;
  return scene;
}

GBuffer rendered(const DiffuseScene& scene) {
  ViewOptions options;
  options.width = options.height = 6;
  return render_gbuffer(TraceScene(scene, "4.3.2"), nullptr, options);
}

TEST(RenderGBuffer, NormalsAreTheMapsInTheWorld) {
  const Vec3 normal(0.6F, 0, 0.8F);
  const GBuffer buffer = rendered(tilted_floor(normal));
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) {
      const auto n = buffer.normal.texel(x, y), face = buffer.face.texel(x, y);
      EXPECT_LT((Vec3(n[0], n[1], n[2]) - normal).length(), 1e-5F);
      EXPECT_EQ(Vec3(face[0], face[1], face[2]), Vec3(0, 0, 1));
    }
  }
}

/// Every position, by the header's matrix, lies on its pixel's ray, and its depth along -z.
TEST(RenderGBuffer, TheFileLeadsFromTheWorldToThePixel) {
  const DiffuseScene scene = tilted_floor({0, 0, 1});
  const TempFolder folder;
  const auto file = folder.path() / "g.exr";
  write_exr(file, gbuffer_layers(rendered(scene), scene), Depth::full);
  const LayeredImage image = read_image(file);
  EXPECT_EQ(std::get<std::string>(image.attributes.at("rnmbake:space")), "world");
  EXPECT_EQ(std::get<std::string>(image.attributes.at("rnmbake:objects")), R"(["floor"])");
  const auto matrix = std::get<std::vector<float>>(image.attributes.at("rnmbake:to_camera"));
  ASSERT_EQ(matrix.size(), 16U);
  const Layer* positions = image.find("position");
  const Layer* depths = image.find("depth");
  ASSERT_NE(positions, nullptr);
  ASSERT_NE(depths, nullptr);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) {
      const auto p = positions->pixels.texel(x, y);
      const auto row = [&](std::size_t r) {
        return double(matrix[4 * r] * p[0] + matrix[4 * r + 1] * p[1] + matrix[4 * r + 2] * p[2] +
                      matrix[4 * r + 3]);
      };
      const double depth = depths->pixels.texel(x, y)[0], half = std::tan(0.25);
      EXPECT_NEAR(-row(2), depth, 1e-5);
      EXPECT_NEAR(row(0) / depth, half * ((x + 0.5) / 3 - 1), 1e-5);
      EXPECT_NEAR(row(1) / depth, half * (1 - (y + 0.5) / 3), 1e-5);
    }
  }
  for (const char* layer : {"normal", "face", "object", "coverage"})
    EXPECT_NE(image.find(layer), nullptr) << layer;
}

TEST(RenderGBuffer, ASceneWithoutACameraIsRefused) {
  DiffuseScene scene = tilted_floor({0, 0, 1});
  scene.camera.reset();
  try {
    (void)rendered(scene);
    FAIL() << "a G-buffer without a camera";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
  }
}

}  // namespace
}  // namespace rnmbake
