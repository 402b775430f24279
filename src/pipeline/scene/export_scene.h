// pipeline/scene/export_scene.h - the scene for the reference tracer, and its targets.
#pragma once

#include "blender/blender_session.h"
#include "pipeline/scene/make_targets.h"
#include "pipeline/scene/scene_survey.h"
#include "scene/diffuse_scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace rnmbake {

struct ExportResult {
  DiffuseScene diffuse_scene;
  TargetList list;                    // of the survey's objects
  std::optional<SceneBlends> blends;  // none where the scene was a .rnmscene already
  std::string content;                // hash of what light depends on
};

/// Launches Blender twice (albedo and emission, then everything else), and once more where something has to
/// be unwrapped: meshes then have their UVs as layer "Lightmap". The materials are the lambert ones whatever
/// the settings say. A scene file that is a .rnmscene already is read instead. Where no file changed since an
/// earlier run, what that one kept is taken, unless `anew`. Throws like survey_scene(), make_targets() and
/// read_diffuse_scene().
[[nodiscard]] ExportResult export_scene(BlenderSession& session, bool anew = false);

/// The same for those who have no use for targets: the list stays empty, nothing is unwrapped, and UVs made
/// for lightmaps may be as they like.
[[nodiscard]] ExportResult export_surfaces(BlenderSession& session, bool anew = false);

/// Whether the scene of the settings is a .rnmscene file.
[[nodiscard]] bool is_rnmscene(const std::filesystem::path& file);

}  // namespace rnmbake
