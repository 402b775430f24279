// pipeline/lightmaps/deliver_lightmap.h - one target's pictures become its files, whoever made the pictures.
#pragma once

#include "bake/targets.h"
#include "config/bake_settings.h"
#include "image/bakes.h"
#include "jobs/folder_lock.h"
#include "lightmap/extra_layers.h"
#include "lightmap/merge.h"
#include "lightmap/metadata.h"
#include "scene/surface.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rnmbake {

/// One lightmap that was written.
struct Delivered {
  std::vector<std::string> files;  // names within the output folder
  MergeCounts counts;
  int samples = 0;            // that it has
  double standard_error = 0;  // of its texels over their mean (lightmap/half_errors.h); 0: not known
  std::vector<std::string> hashes = {};  // [files] of their bytes, XXH3 of 128 bits
};
struct NotDelivered {
  std::string reason;
};
/// Outcome of a target; empty: not complete yet.
using Delivery = std::optional<std::variant<Delivered, NotDelivered>>;

/// Number of targets without a lightmap.
[[nodiscard]] std::size_t count_failed(const std::vector<Delivery>& deliveries);

/// Logs why a target has no lightmap, as an event (docs/logs.md). `line`: what people read.
[[nodiscard]] NotDelivered not_delivered(const std::string& key, const std::string& reason,
                                         const std::string& line);

/// Warns in one line of all lightmaps that are black.
void warn_of_black(const std::vector<Target>& targets, const std::vector<Delivery>& deliveries);

/// Name, metadata and dilation of a target's files.
struct LightmapHeader {
  std::string stem;           // of its file names
  LightmapMetadata metadata;  // for the headers
  int dilate = 4;
  std::shared_ptr<const Surface> surface;  // where the identity or the frames need it
};

/// Whether a bake's maps get a layer of standard errors beside them.
[[nodiscard]] bool has_error_layers(const OutputSettings& output);

/// Makes the folder, holds it (pipeline/run/hold_folder.h) and finds out that nothing can be written there
/// before hours of work. Throws Error(usage) where none is set, Error(io), Error(lock_held), Interrupted.
[[nodiscard]] FolderLock prepare_output(const OutputSettings& output, const RunSettings& run);

/// Merges, writes the header and the files; warns of repaired texels. `header.metadata` lacks only its bases.
/// Throws Error(io), and Error(tasks_failed) where no texel holds a number.
[[nodiscard]] Delivered deliver_lightmap(const TargetBakes& bakes, const LightmapHeader& header,
                                         const OutputSettings& output, ExtraLayers extra = {});

}  // namespace rnmbake
