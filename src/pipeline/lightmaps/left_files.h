// pipeline/lightmaps/left_files.h - files of lightmaps that manifest.json listed once and lists no more,
// because their object left the scene or has other files now; kept in mind in DIR/.rnmbake-left.json.
#pragma once

#include "scene/survey.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Adds what `before`, the manifest that is about to be replaced (null: none), lists and `now` does not.
/// Files of objects that are in the scene and were not baked now stay out: they may be all that there is of
/// them.
void note_left_files(const std::filesystem::path& dir, const nlohmann::json& before,
                     const nlohmann::json& now, const SceneSurvey& survey);

/// What became of the files left in a folder: names in it.
struct Pruned {
  std::vector<std::string> removed;
  std::vector<std::string> changed;  // not those that were baked; still there
};

/// Deletes the files that note_left_files() noted, but for what was changed since it was baked and what
/// manifest.json lists again. The caller holds the folder. Throws Error(io) where a file cannot be deleted.
Pruned prune_left_files(const std::filesystem::path& dir);

}  // namespace rnmbake
