#include "pipeline/deliver/glb.h"

#include "base/files.h"
#include "blender/blend_path.h"
#include "pipeline/scene/scene_survey.h"

#include <utility>

namespace rnmbake {
namespace {

using nlohmann::json;

/// v upwards, as Blender has it: 1 - v' = (1 - v) s + o.
json placed(const PageLayout& layout, const PagedMap& map, const std::string& object) {
  const Imath::V2d scale = map.scale(layout.pages[map.page]), offset = map.offset(layout.pages[map.page]);
  return {{"object", object},
          {"key", map.key},
          {"page", map.page},
          {"scale", {scale.x, scale.y}},
          {"offset", {offset.x, 1 - scale.y - offset.y}}};
}

}  // namespace

GlbResult write_glb(BlenderSession& session, const PageLayout& layout,
                    const std::vector<std::string>& objects, const GlbRequest& request,
                    const std::filesystem::path& file) {
  write_atomically(file, " ");
  Launch launch = launch_on(session, "deliver_entry.py", "deliver", BlendPath(session.settings().scene.file));
  json list = json::array(), pictures = json::array();
  for (std::size_t i = 0; i < layout.maps.size(); ++i)
    list.push_back(placed(layout, layout.maps[i], objects[i]));
  for (const std::filesystem::path& picture : request.pictures) pictures.push_back(picture.string());
  launch.request.update({{"objects", std::move(list)},
                         {"pages", std::move(pictures)},
                         {"intensity", request.intensity},
                         {"record", request.record},
                         {"lights", request.lights}});
  launch.save_as = file;
  const json answer = session.run(std::move(launch));
  GlbResult result;
  result.notes = answer.at("notes").get<std::vector<std::string>>();
  const json& nodes = answer.at("nodes");
  for (std::size_t i = 0; i < layout.maps.size(); ++i) {
    const json& node = nodes.at(i);
    if (node.is_null()) {
      result.notes.push_back("object '" + objects[i] +
                             "' was left out by Blender's glTF exporter: it is not shown");
      continue;
    }
    result.nodes[layout.maps[i].key] = {node.at("node").get<int>(), node.at("mesh").get<int>(),
                                        node.at("name").get<std::string>()};
  }
  return result;
}

}  // namespace rnmbake
