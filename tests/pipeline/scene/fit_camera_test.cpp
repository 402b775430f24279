#include "pipeline/scene/fit_camera.h"

#include "pipeline/traced_scene.h"
#include "trace/view.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Where a point lies in the picture, in half widths and half heights from its middle.
Vec2 in_picture(const Camera& camera, const Vec3d& point) {
  Vec3d seen;
  camera.to_world.inverse().multVecMatrix(point, seen);
  EXPECT_LT(seen.z, 0);
  return {float(seen.x / -seen.z / std::tan(camera.angle_x / 2)),
          float(seen.y / -seen.z / std::tan(camera.angle_y / 2))};
}

TEST(FitCamera, FramesAllThatIsBakedAndNoMore) {
  ExportResult scene = floor_under_sky();
  add_object(scene.diffuse_scene, "far away", {level(1000, 5)}, Vec3(0.5F));  // not baked
  for (const auto& size : {std::pair(960, 540), std::pair(200, 400)}) {
    const Camera camera = fit_camera(scene.diffuse_scene.survey, scene.list.targets, size);
    EXPECT_NEAR(pixel_shape(camera), 1, 1e-9);
    float most = 0;
    const SceneObject& floor = scene.diffuse_scene.survey.objects[0];
    for (const Vec3& position : scene.diffuse_scene.survey.mesh_of(floor).positions) {
      const Vec2 at = in_picture(camera, Vec3d(position));
      most = std::max({most, std::abs(at.x), std::abs(at.y)});
    }
    EXPECT_NEAR(most, 0.9, 0.02);  // its own border: the floor is the box
    const Vec3d place = camera.to_world.translation();
    EXPECT_TRUE(place.x > 0 && place.y < 0 && place.z > 0);
  }
}

/// As `export_surfaces` leaves scenes.
TEST(FitCamera, FramesAllThereIsWhereNothingIsBaked) {
  const ExportResult scene = floor_under_sky();
  const SceneSurvey& survey = scene.diffuse_scene.survey;
  EXPECT_EQ(fit_camera(survey, {}, {960, 540}).to_world,
            fit_camera(survey, scene.list.targets, {960, 540}).to_world);
}

TEST(FitCamera, GivesWayToTheScenesOwn) {
  ExportResult scene = floor_under_sky();
  scene.diffuse_scene.camera = Camera{};
  scene.diffuse_scene.camera->name = "own";
  give_camera(scene);
  EXPECT_EQ(scene.diffuse_scene.camera->name, "own");
  give_camera(scene, true);
  EXPECT_EQ(scene.diffuse_scene.camera->name, "fit");
}

}  // namespace
}  // namespace rnmbake
