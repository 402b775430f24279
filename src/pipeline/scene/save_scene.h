// pipeline/scene/save_scene.h - a copy of the scene that holds the lightmap UVs which this bake made.
#pragma once

#include "bake/targets.h"
#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "scene/survey.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace rnmbake {

/// Object and layer of a lightmap in the saved scene.
struct SavedPlace {
  std::string object;  // name in that scene
  int uv_index = -1;   // of the lightmap's layer
};

struct SavedScene {
  std::string file;                           // name in the output folder, "" if none was saved
  std::map<std::size_t, SavedPlace> objects;  // by index into SceneSurvey::objects
};

/// An object's lightmap UVs as the saved scene is to hold them.
struct SavedUvs {
  std::size_t object = 0;  // index into SceneSurvey::objects
  std::string layer;
  Uvs uv;  // what was unwrapped; null: the layer is the object's own
};

/// The objects of the targets, each once, in the targets' order.
[[nodiscard]] std::vector<SavedUvs> uvs_of(const std::vector<Target>& targets);

/// Writes DIR/<scene>.lightmap-uvs.blend, whole or not at all, if the settings want it (when_unwrapped: only
/// if something was): the lightmap is every object's second UV layer, relative paths lead where they did.
/// Throws as BlenderSession::run() and Error(io).
[[nodiscard]] SavedScene save_scene_with_uvs(BlenderSession& session, const SceneSurvey& survey,
                                             const BlendPath& own, const std::vector<SavedUvs>& objects);

}  // namespace rnmbake
