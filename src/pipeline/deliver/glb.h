// pipeline/deliver/glb.h - the saved scene as a .glb with its lightmaps, by Blender's own exporter.
#pragma once

#include "blender/blender_session.h"
#include "pipeline/deliver/pages.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

struct GlbRequest {
  std::vector<std::filesystem::path> pictures;  // PNG of each page
  double intensity = 0;                         // of their values: to irradiance
  nlohmann::json record;                        // for the root's extras
  bool lights = false;
};

struct GlbNode {
  int node = 0, mesh = 0;  // indices in the .glb
  std::string name;
};

struct GlbResult {
  std::map<std::string, GlbNode> nodes;  // by key; without objects that the exporter left out
  std::vector<std::string> notes;        // of what glTF cannot say
};

/// `objects`: name of each map's object in the saved scene, in the layout's order. One launch. Writes `file`,
/// which is this run's own.
[[nodiscard]] GlbResult write_glb(BlenderSession& session, const PageLayout& layout,
                                  const std::vector<std::string>& objects, const GlbRequest& request,
                                  const std::filesystem::path& file);

}  // namespace rnmbake
