// tests/pipeline/traced_scene.h - a scene of a few quads as an export would give it, with its targets.
#pragma once

#include "pipeline/scene/export_scene.h"
#include "trace/trace_scenes.h"

#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace rnmbake {

/// A whole object as target of `side` texels, with its first UV layer.
inline void add_target(ExportResult& exported, std::size_t object, int side) {
  const SceneSurvey& survey = exported.diffuse_scene.survey;
  const SceneObject& it = survey.objects[object];
  Target target;
  target.object = object;
  target.key = it.key;
  target.part.triangles.resize(survey.mesh_of(it).triangles());
  std::iota(target.part.triangles.begin(), target.part.triangles.end(), 0U);
  target.uv = target.tangent_uv =
      std::make_shared<const std::vector<Vec2>>(survey.mesh_of(it).uv_layers.front().uv);
  target.uv_layer = target.tangent_layer = "Lightmap";
  target.width = target.height = side;
  exported.list.targets.push_back(std::move(target));
  exported.list.settings.emplace_back();
  exported.list.settings.back().samples = 16;
  exported.list.settings.back().dilate = 0;
}

/// A floor that looks up into a world of that radiance.
inline ExportResult floor_under_sky(float radiance = 1) {
  ExportResult exported;
  exported.diffuse_scene.survey.blender_version = "4.3.2";
  exported.diffuse_scene.world.radiance = Vec3(radiance);
  add_object(exported.diffuse_scene, "floor", {level(1, 0)}, Vec3(0.5F));
  add_target(exported, 0, 8);
  return exported;
}

}  // namespace rnmbake
