// pipeline/lightmaps/earlier_lightmaps.h - lightmaps that an earlier run left in the output folder, of
// objects that this run leaves alone: they stay in the manifest, and their UVs in the saved scene.
#pragma once

#include "bake/targets.h"
#include "blender/blender_session.h"
#include "encoding/basis_set.h"
#include "pipeline/scene/save_scene.h"
#include "scene/survey.h"

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

struct EarlierLightmap {
  std::size_t object = 0;  // index into SceneSurvey::objects
  nlohmann::json entry;    // of the manifest; "earlier" holds the facts of that whole run
  Uvs uv;                  // unwrapped by that run; null: the object's own, or in no file
};

struct EarlierLightmaps {
  std::vector<EarlierLightmap> kept;
  std::string scene_with_uvs;  // name in the folder, "" if there is none

  /// Stem of its files' names.
  [[nodiscard]] std::vector<std::string> stems() const;

  /// `of_targets` and the unwrapped UVs of these lightmaps, all of which the saved scene has to hold.
  [[nodiscard]] std::vector<SavedUvs> add_to(std::vector<SavedUvs> of_targets) const;
};

/// Command and bases of this run; lightmaps of others do not fit its manifest.
struct RunKind {
  std::string kind;  // bake, reference
  const std::vector<BasisDirection>& bases;
};

/// Reads the output folder's manifest, and where something was unwrapped then the scene that was saved (one
/// launch). Lightmaps that no longer fit the scene are left out, with a warning. Throws Error(usage) where
/// lightmaps of both runs cannot stand in one manifest: other bases, another scene.
[[nodiscard]] EarlierLightmaps find_earlier(BlenderSession& session, const RunKind& run,
                                            const SceneSurvey& survey, const std::vector<Target>& targets);

}  // namespace rnmbake
