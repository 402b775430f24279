// blender/blend_path.h - a file that Blender's own command line opens, never one that must be imported first.
#pragma once

#include <filesystem>
#include <string>

namespace rnmbake {

/// Whether a name ends as Blender's own files do, in letters of any case.
[[nodiscard]] bool is_blend(const std::filesystem::path& file);

/// Absolute path of a .blend. Launches take this in place of a path, so that none is handed the user's .glb:
/// import_scene() in pipeline/scene/scene_survey.h turns that into a .blend once for all of them.
class BlendPath {
 public:
  /// Throws std::invalid_argument unless is_blend(): a defect of the caller.
  explicit BlendPath(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::string string() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace rnmbake
