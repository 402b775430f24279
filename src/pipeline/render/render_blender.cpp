#include "pipeline/render/render_blender.h"

#include "base/error.h"
#include "base/log.h"
#include "config/settings.h"
#include "image/layered_exr.h"
#include "pipeline/render/render_view.h"
#include "pipeline/scene/launch_answer.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <variant>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// As docs/rnmscene-format.md has it: Blender's matrices are the transpose of ours.
json to_json(const Camera& camera) {
  json matrix = json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) matrix.push_back(camera.to_world[column][row]);
  }
  return {{"matrix", matrix},      {"orthographic", camera.orthographic}, {"angle_x", camera.angle_x},
          {"width", camera.width}, {"shift_x", camera.shift_x},           {"shift_y", camera.shift_y}};
}

/// As scene_ops/cycles.py wants it: "CPU", "CUDA", ...
std::string device_of(const BakeSettings& settings) {
  auto name = std::get<std::string>(find_setting("device")->slot.get(settings));
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

FloatImage read_picture(const fs::path& file, const BlenderViewOptions& options) {
  LayeredImage image = read_image(file);
  if (image.layers.size() != 1 || image.layers[0].pixels.channels() != 3 ||
      image.layers[0].pixels.width() != options.width || image.layers[0].pixels.height() != options.height) {
    fail(ExitCode::tasks_failed, "Blender rendered another picture than the {} x {} one it was asked for",
         options.width, options.height);
  }
  return std::move(image.layers[0].pixels);
}

}  // namespace

BlenderViewOptions blender_view(const BlenderSession& session, const ViewOptions& view, bool own_materials) {
  const BakeSettings& settings = session.settings();
  return {BlenderEngine::cycles,  view.width,   view.height, view.samples, settings.bake.bounces,
          {settings.object.seed}, own_materials};
}

std::vector<FloatImage> render_blender(BlenderSession& session, const ExportResult& exported,
                                       const BlenderViewOptions& options) {
  const BakeSettings& settings = session.settings();
  const Camera& camera = camera_of(exported.diffuse_scene);
  if (!exported.blends) {
    fail(ExitCode::usage, "{}: Blender needs the scene that this was exported from; give that .blend",
         settings.scene.file.string());
  }
  const BlendPath& scene = options.own_materials ? exported.blends->own : exported.blends->shown;
  Launch launch = launch_on(session, "render_entry.py", "render", scene);
  launch.request["camera"] = to_json(camera);
  launch.request["pixel_shape"] = pixel_shape(camera);
  launch.request["width"] = options.width;
  launch.request["height"] = options.height;
  launch.request["normal_maps"] = !options.own_materials;
  launch.request["engine"] = options.engine == BlenderEngine::eevee ? "eevee" : "cycles";
  launch.request["seeds"] = options.seeds;
  launch.request["cycles"] = {{"samples", options.samples},
                              {"bounces", options.bounces},
                              {"seed", 0},
                              {"clamp", 0},
                              {"device", device_of(settings)}};
  const fs::path folder = launch.folder;
  log::info("{} renders {} x {} pixels", options.engine == BlenderEngine::eevee ? "Eevee" : "Cycles",
            options.width, options.height);
  const json answer = session.run(std::move(launch));
  std::vector<FloatImage> pictures;
  for (const json& name : answer.at("pictures"))
    pictures.push_back(read_picture(answered_file(name, folder), options));
  return pictures;
}

}  // namespace rnmbake
