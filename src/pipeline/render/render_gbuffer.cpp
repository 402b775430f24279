#include "pipeline/render/render_gbuffer.h"

#include "base/log.h"
#include "base/progress.h"
#include "blender/blender_session.h"
#include "pipeline/render/render_surfaces.h"
#include "pipeline/render/render_view.h"
#include "process/stop.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

std::string names_of_objects(const DiffuseScene& scene) {
  auto names = nlohmann::json::array();
  for (const SceneObject& object : scene.survey.objects) names.push_back(object.key);
  return names.dump();
}

/// Row by row, for column vectors.
std::vector<float> to_camera(const Camera& camera) {
  const Mat44 inverse = camera.to_world.inverse();
  std::vector<float> numbers;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) numbers.push_back(static_cast<float>(inverse[column][row]));
  return numbers;
}

}  // namespace

GBuffer render_gbuffer(const TraceScene& scene, const SceneLightmaps* lightmaps, const ViewOptions& options) {
  const RenderSurfaces surfaces(
      scene, lightmaps == nullptr ? std::map<std::size_t, std::string>{} : lightmaps->tangent_layers());
  Progress progress("rendering", progress_for(log::is_quiet(), log::is_jsonl()));
  GBuffer gbuffer = trace_gbuffer(
      scene, camera_of(scene.diffuse_scene()), options,
      [&](const Vertex& vertex) { return surfaces.to_world(vertex, surfaces.mapped_normal(vertex)); },
      [&](double share) { progress.update(share, "G-buffer"); }, [] { return StopRequest::requested(); });
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  return gbuffer;
}

LayeredImage gbuffer_layers(GBuffer&& gbuffer, const DiffuseScene& scene) {
  LayeredImage image;
  const std::vector<std::string> axes{"X", "Y", "Z"}, one{""};
  image.layers.push_back({"normal", axes, std::move(gbuffer.normal)});
  image.layers.push_back({"face", axes, std::move(gbuffer.face)});
  image.layers.push_back({"position", axes, std::move(gbuffer.position)});
  image.layers.push_back({"depth", one, std::move(gbuffer.depth)});
  image.layers.push_back({"object", one, std::move(gbuffer.object)});
  image.layers.push_back({"coverage", one, std::move(gbuffer.coverage)});
  image.attributes["rnmbake:rendered"] = "gbuffer";
  image.attributes["rnmbake:space"] = "world";
  image.attributes["rnmbake:to_camera"] = to_camera(camera_of(scene));
  image.attributes["rnmbake:objects"] = names_of_objects(scene);
  return image;
}

}  // namespace rnmbake
