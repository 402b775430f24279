// pipeline/scene/fit_camera.h - a view for scenes whose own camera is missing or not wanted.
#pragma once

#include "bake/targets.h"
#include "pipeline/scene/export_scene.h"
#include "scene/diffuse_scene.h"

#include <optional>
#include <utility>
#include <vector>

namespace rnmbake {

/// Camera to the right of the front and above (Blender's front is -y), so that the axis-aligned box of all
/// targets, of all objects where there is no target, just fits into a picture of that size in pixels. It
/// stands outside of that box, so it shows closed rooms from outside.
[[nodiscard]] Camera fit_camera(const SceneSurvey& survey, const std::vector<Target>& targets,
                                std::pair<int, int> size);

/// Gives the scene that camera where it has none, or `always`; says so. Without a size: 960 x 540.
void give_camera(ExportResult& exported, bool always = false,
                 const std::optional<std::pair<int, int>>& size = std::nullopt);

}  // namespace rnmbake
