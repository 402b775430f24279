// closed_forms/workbench.h - builds scenes of scenes/ with one Blender and bakes them with the real rnmbake.
#pragma once

#include "base/files.h"
#include "blender/probe.h"
#include "image/layered_exr.h"
#include "scene/survey.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

using Words = std::vector<std::string>;

/// A scene's name in scenes/make.py with its key=value parameters.
struct SceneChoice {
  std::string name;
  Words parameters;
};

/// The lightmaps of one run of `rnmbake bake` or `rnmbake reference`.
class Baked {
 public:
  explicit Baked(const std::filesystem::path& folder);

  /// The lightmap of an object; Error(tasks_failed) where the manifest knows none.
  [[nodiscard]] LayeredImage lightmap(const std::string& object) const;

 private:
  std::map<std::string, std::filesystem::path> files_;
};

/// All it writes lies in a folder that goes with it. What a program says goes into the Error that reports its
/// failure.
class Workbench {
 public:
  /// `binary`: rnmbake; `blender`: as --blender, else the default one.
  Workbench(std::filesystem::path binary, const std::optional<std::string>& blender);

  [[nodiscard]] const BlenderInfo& blender() const { return blender_; }

  /// The .blend of a scene, built by this Blender.
  [[nodiscard]] std::filesystem::path build(const SceneChoice& scene);

  /// Bakes with 32-bit output, undilated, plus `flags`.
  [[nodiscard]] Baked bake(const std::filesystem::path& blend, const Words& flags);

  /// Traces the same way.
  [[nodiscard]] Baked reference(const std::filesystem::path& scene, const Words& flags);

  /// The .rnmscene of a scene.
  [[nodiscard]] std::filesystem::path exported(const std::filesystem::path& blend);

  [[nodiscard]] SceneSurvey survey(const std::filesystem::path& blend);

 private:
  std::filesystem::path new_path(const std::string& name);
  Baked lightmaps(const char* command, const std::filesystem::path& scene, const Words& flags);

  TempFolder folder_;
  std::filesystem::path binary_;
  BlenderInfo blender_;
  int count_ = 0;
};

}  // namespace rnmbake
