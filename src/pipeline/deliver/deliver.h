// pipeline/deliver/deliver.h - a bake's folder becomes what an engine opens.
#pragma once

#include "blender/blender_session.h"
#include "pipeline/deliver/engine_target.h"
#include "pipeline/deliver/pages.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct DeliverOptions {
  const EngineTarget* engine = nullptr;
  std::string encoding;              // of the pages; "": the engine's own choice
  int side = 4096;                   // of pages, at most, texels
  int padding = 4;                   // texels around surfaces that are filled from them
  std::optional<PageFormat> format;  // of the pages; else the engine's own choice
  std::optional<int> mips;           // levels below the first; else as many as the padding allows, with ktx2
  bool zstd = false;                 // compresses ktx2
  bool lights = false;               // the scene's lamps go into the .glb, too
};

struct DeliverySummary {
  std::vector<std::string> files;  // names in the folder, lightmaps.json last
  std::size_t written = 0;         // of these; the others were the same already
  PageLayout layout;
  PageForm form;
  std::vector<PageLoss> losses;    // of what the pages were made from, by their format
  std::vector<std::string> notes;  // of what glTF cannot say, or the exporter left out
};

/// The saved scene of `lightmaps`, which deliver() opens. Throws Error(unsupported) where the folder holds
/// parts of objects, or no scene with the maps' UVs, naming the remedy; else as open_lightmaps().
[[nodiscard]] std::filesystem::path scene_to_deliver(const std::filesystem::path& lightmaps);

/// Throws Error(unsupported) where the engine has no decoder for the encoding or does not read pages of the
/// format, Error(usage) where the format has no mipmaps or Zstandard that are asked for, or the padding is
/// too small for them.
void check(const DeliverOptions& options);

/// Writes into the session's output folder, which is held for as long: all files, whole or not at all each,
/// lightmaps.json last; files that an earlier delivery wrote and this one has no use for are removed. Files
/// that hold the same bytes are left alone. The session's scene is scene_to_deliver(). Throws as
/// scene_to_deliver(), check(), lay_out_pages(), convert_lightmaps() and BlenderSession::run(),
/// Error(unsupported) where the pages' format cannot hold a layer.
[[nodiscard]] DeliverySummary deliver(BlenderSession& session, const std::filesystem::path& lightmaps,
                                      const DeliverOptions& options,
                                      const std::function<void(double, std::string)>& progress = {});

}  // namespace rnmbake
