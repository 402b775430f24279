// pipeline/lightmaps/deliver_lightmap.h - one target's pictures become its files, whoever made the pictures.
#pragma once

#include "bake/targets.h"
#include "config/bake_settings.h"
#include "image/bakes.h"
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
};
struct NotDelivered {
  std::string reason;
};
/// How it ended for a target; empty: not yet.
using Delivery = std::optional<std::variant<Delivered, NotDelivered>>;

/// Targets without a lightmap.
[[nodiscard]] std::size_t count_failed(const std::vector<Delivery>& deliveries);

/// One line for all lightmaps in which no texel got any light.
void warn_of_black(const std::vector<Target>& targets, const std::vector<Delivery>& deliveries);

/// What a lightmap's files say of their target, and how they are filled.
struct LightmapHeader {
  std::string stem;           // of its file names
  LightmapMetadata metadata;  // for the headers
  int dilate = 4;
  std::shared_ptr<const Surface> surface;  // where the identity or the frames need it
};

/// Makes the folder and finds out that nothing can be written there before hours of work. Throws Error(usage)
/// where none is set, Error(io).
void prepare_output(const OutputSettings& output);

/// Merges, writes the header and the files; warns of what had to be mended. `header.metadata` lacks only its
/// bases. Throws Error(io), and Error(tasks_failed) where no texel holds a number.
[[nodiscard]] Delivered deliver_lightmap(const TargetBakes& bakes, const LightmapHeader& header,
                                         const OutputSettings& output, ExtraLayers extra = {});

}  // namespace rnmbake
