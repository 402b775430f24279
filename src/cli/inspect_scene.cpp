#include "cli/inspect_scene.h"

#include "bake/targets.h"
#include "bake/uv_problems.h"
#include "base/error.h"
#include "base/text.h"

#include <cstdint>

namespace rnmbake {
namespace {

constexpr double packing_guess = 0.6;  // share of the square that charts fill after unwrapping

const UvLayer& layer_of(const Mesh& mesh, int layer) {
  return mesh.uv_layers[static_cast<std::size_t>(layer)];
}

void report_uvs(InspectedObject& inspected, const ObjectSettings& settings) {
  const Mesh& mesh = *inspected.mesh;
  const SceneObject& object = *inspected.object;
  const UvChoice choice = choose_lightmap_uv(mesh, settings, object.key);
  if (const auto tangent = choose_tangent_uv(mesh, settings, object.key))
    inspected.tangent_layer = layer_of(mesh, *tangent).name;
  if (!choice.layer) {
    const std::vector<Vec2> none(mesh.loop_vertex.size(), Vec2(0));
    const double world = areas(mesh, mesh.all_triangles(), none, object.to_world).world;
    inspected.resolution = choose_resolution(settings, {world, packing_guess});
    inspected.problems.push_back("would be unwrapped: " + choice.reason);
    return;
  }
  const UvLayer& layer = layer_of(mesh, *choice.layer);
  inspected.lightmap_layer = layer.name;
  const Areas sizes = areas(mesh, mesh.all_triangles(), layer.uv, object.to_world);
  inspected.resolution = choose_resolution(settings, sizes);
  inspected.uv = report_uv(mesh, layer.uv, object.to_world, inspected.resolution, inspected.resolution);
  const int wanted = wanted_resolution(settings, sizes);
  for (const UvProblem& problem : uv_problems(*inspected.uv, inspected.resolution, wanted))
    inspected.problems.push_back(spoken(problem));
}

InspectedObject inspect_object(const SceneSurvey& survey, const SceneObject& object,
                               const ResolvedConfig& config) {
  InspectedObject inspected;
  inspected.object = &object;
  inspected.mesh = &survey.mesh_of(object);
  if (!config.selects(object.name, object.key)) inspected.not_baked = not_selected;
  if (inspected.mesh->triangles() == 0)
    inspected.not_baked = "no faces";
  else if (!has_surface(*inspected.mesh, inspected.mesh->all_triangles(), object.to_world))
    inspected.not_baked = "no area";
  if (!inspected.not_baked.empty()) return inspected;
  try {
    const ObjectSettings settings = config.for_object(object.name, object.key);
    report_uvs(inspected, settings);
    inspected.parts = split_mesh(*inspected.mesh, object.slots, settings.split).size();
  } catch (const Error& error) {  // a bake would stop here; inspecting goes on
    if (error.code() == ExitCode::usage) throw;
    inspected.not_baked = error.what();
  }
  return inspected;
}

}  // namespace

Inspection inspect_scene(const SceneSurvey& survey, const ResolvedConfig& config) {
  Inspection inspection;
  for (const SceneObject& object : survey.objects)
    inspection.objects.push_back(inspect_object(survey, object, config));
  for (const auto& [name, material] : survey.materials) {
    if (!material.outside_model.empty()) inspection.outside_model.push_back(&material);
  }
  return inspection;
}

}  // namespace rnmbake
