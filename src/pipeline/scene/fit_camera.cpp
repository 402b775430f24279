#include "pipeline/scene/fit_camera.h"

#include "base/log.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

constexpr double half_width = 0.36;  // tangent of half the horizontal field of view: a lens of 50 mm on 36 mm
constexpr double border = 0.05;      // of the picture, at least, left free on each side
constexpr std::pair default_size{960, 540};
const Vec3d towards_camera(0.5, -1, 0.55);

struct Box {
  Vec3d low = Vec3d(std::numeric_limits<double>::infinity());
  Vec3d high = -low;
};

void add(const SceneSurvey& survey, const SceneObject& object, const std::vector<std::uint32_t>& triangles,
         Box& box) {
  const Mesh& mesh = survey.mesh_of(object);
  for (const std::uint32_t triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3d place;
      const std::size_t corner = 3 * std::size_t(triangle) + k;
      object.to_world.multVecMatrix(Vec3d(mesh.positions[mesh.corner_vertex(corner)]), place);
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], place[axis]);
        box.high[axis] = std::max(box.high[axis], place[axis]);
      }
    }
  }
}

Box box_of(const SceneSurvey& survey, const std::vector<Target>& targets) {
  Box box;
  for (const Target& target : targets) add(survey, survey.objects[target.object], target.part.triangles, box);
  if (!targets.empty()) return box;
  for (const SceneObject& object : survey.objects)
    add(survey, object, survey.mesh_of(object).all_triangles(), box);
  return box;
}

}  // namespace

Camera fit_camera(const SceneSurvey& survey, const std::vector<Target>& targets, std::pair<int, int> size) {
  const double half_height = half_width * size.second / size.first;
  const Vec3d back = towards_camera.normalized();
  const Vec3d right = Vec3d(0, 0, 1).cross(back).normalized(), up = back.cross(right);
  const Box box = box_of(survey, targets);
  const Vec3d centre = (box.low + box.high) * 0.5, half = (box.high - box.low) * 0.5;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d at((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                   (corner & 4) != 0 ? half.z : -half.z);
    const double across = std::abs(at.dot(right)) / half_width, along = std::abs(at.dot(up)) / half_height;
    distance = std::max(distance, at.dot(back) + std::max(across, along) / (1 - 2 * border));
  }
  const Vec3d place = centre + back * distance;
  Camera camera;
  camera.name = "fit";
  camera.to_world = Mat44(right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, back.x, back.y, back.z, 0,
                          place.x, place.y, place.z, 1);
  camera.angle_x = 2 * std::atan(half_width);
  camera.angle_y = 2 * std::atan(half_height);
  camera.resolution_x = size.first;
  camera.resolution_y = size.second;
  return camera;
}

void give_camera(ExportResult& exported, bool always, const std::optional<std::pair<int, int>>& size) {
  std::optional<Camera>& camera = exported.diffuse_scene.camera;
  if (camera && !always) return;
  if (!camera) log::info("the scene has no plain camera; looking at all of it (--camera fit)");
  camera = fit_camera(exported.diffuse_scene.survey, exported.list.targets, size.value_or(default_size));
}

}  // namespace rnmbake
