// lightmap/layout.h - one lightmap as several files, for engines that know no layers.
#pragma once

#include "image/layered_exr.h"

#include <string>
#include <vector>

namespace rnmbake {

/// Header attribute of a file that holds one layer only: its name.
inline constexpr const char* layer_attribute = "rnmbake:layer";

struct LayerFile {
  std::string name;  // "flat", "rnm0", "coverage", ...: goes into the file's name
  LayeredImage image;
};

/// Every layer as an image of its own with plain channels (R,G,B or Y). Each repeats the whole header and
/// adds layer_attribute.
[[nodiscard]] std::vector<LayerFile> one_file_per_layer(LayeredImage lightmap);

}  // namespace rnmbake
