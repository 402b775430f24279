// lightmap/layout.h - one lightmap as several files, for engines that know no layers.
#pragma once

#include "image/layered_exr.h"

#include <string>
#include <vector>

namespace rnmbake {

struct LayerFile {
  std::string name;  // "flat", "rnm0", "coverage", ...: goes into the file's name
  LayeredImage image;
};

/// Every layer as an image of its own with plain channels (R,G,B or Y). Each repeats the whole header and
/// adds `rnmbake:layer`, the name of the layer that it holds.
[[nodiscard]] std::vector<LayerFile> one_file_per_layer(LayeredImage lightmap);

}  // namespace rnmbake
