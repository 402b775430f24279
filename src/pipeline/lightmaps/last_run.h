// pipeline/lightmaps/last_run.h - whether the last run into an output folder was this very one.
#pragma once

#include "config/resolve.h"
#include "jobs/run_record.h"
#include "scene/scene_places.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// Compares settings, the program, Blender, and every file that was read or written, by size and time, and
/// by content where those differ. Starts no Blender.
class LastRun {
 public:
  struct Needs {
    bool blender = true;     // else none is looked for
    bool is_settled = true;  // lightmaps that were assumed to be as they were are a reason to run
  };

  /// `command`: "bake", "reference", and a line for each flag of its own that decides what comes out. Throws
  /// Error(environment) where the run needs a Blender and there is none.
  LastRun(const ResolvedConfig& config, const std::string& command, const Needs& needs);

  /// Why it has to be run; empty: it need not be.
  [[nodiscard]] const Reasons& reasons() const { return reasons_; }

  /// Files that it read, without those of the program itself; empty where nothing is known.
  [[nodiscard]] std::vector<InputFile> inputs() const;

  /// What of the scene is not as it was in that run, once it is surveyed; empty where nothing is known.
  [[nodiscard]] Reasons scene_changes(const SceneDigest& now) const;

  /// The scene of that run; nothing where it is not known.
  [[nodiscard]] std::optional<PlacedScene> scene() const;

  /// What else than the scene is not as it was in that run: settings, the program, Blender; "": nothing.
  [[nodiscard]] const std::string& other_than_scene() const { return other_; }

  /// Keeps this run, which made all that it should, for the next one. `inputs`, `scene`: what it read;
  /// `outputs`: what it wrote; `assumed`: lightmaps that were assumed to be as they were.
  void keep(const std::vector<InputFile>& inputs, const PlacedScene& scene, std::vector<RunFile> outputs,
            std::size_t assumed = 0) const;

  /// The record's file in an output folder.
  [[nodiscard]] static std::filesystem::path record_in(const std::filesystem::path& dir);

 private:
  [[nodiscard]] std::filesystem::path record_file() const;
  [[nodiscard]] std::filesystem::path digest_file() const;

  const ResolvedConfig& config_;
  std::filesystem::path blender_;  // empty: not needed
  std::string settings_;
  Reasons reasons_;
  std::string other_ = "nothing was made there before";
  std::vector<RunFile> files_;  // of the last run
};

/// Manifest, lightmaps and scene in a folder of lightmaps, with the hashes that the manifest has of them.
[[nodiscard]] std::vector<RunFile> lightmap_files(const std::filesystem::path& folder);

}  // namespace rnmbake
