// cli/inspect_scene.h - a surveyed scene judged object by object, before anything is written about it.
#pragma once

#include "config/resolve.h"
#include "scene/survey.h"
#include "scene/uv_report.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

inline constexpr const char* not_selected = "not selected";  // InspectedObject::not_baked

struct InspectedObject {
  const SceneObject* object = nullptr;  // in the survey
  const Mesh* mesh = nullptr;
  std::string not_baked;       // reason; "" if it would be baked
  std::string lightmap_layer;  // "" where it would be unwrapped
  std::string tangent_layer;   // "" where the lightmap's layer serves
  int resolution = 0;          // texels along a side of the whole object's lightmap
  std::size_t parts = 1;       // lightmaps: more than one with --split
  std::optional<UvReport> uv;  // of the lightmap layer at that resolution
  std::vector<std::string> problems;
};

struct Inspection {
  std::vector<InspectedObject> objects;            // in the survey's order
  std::vector<const MaterialInfo*> outside_model;  // materials that the reference cannot follow
};

/// The result points into `survey`.
[[nodiscard]] Inspection inspect_scene(const SceneSurvey& survey, const ResolvedConfig& config);

}  // namespace rnmbake
