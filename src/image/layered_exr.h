// image/layered_exr.h - multi-layer OpenEXR files in and out.
#pragma once

#include "base/numeric/stored_values.h"
#include "image/attribute.h"
#include "image/float_image.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rnmbake {

/// One layer of a file. The layer named "" holds the plain channels R,G,B; any other name becomes
/// `name.R`, `name.G`, ... A layer of one channel whose channel name is empty is written as `name` alone
/// (that is how `coverage` is stored).
struct Layer {
  std::string name;
  std::vector<std::string> channels;
  FloatImage pixels;
};

/// "name.R", "R" in the layer "", "name" of a channel "".
[[nodiscard]] std::string channel_name(const Layer& layer, const std::string& channel);

struct LayeredImage {
  std::vector<Layer> layers;
  std::map<std::string, Attribute> attributes;

  [[nodiscard]] const Layer* find(const std::string& name) const;
};

/// Writes all layers (same size) as one scan-line EXR, zip-compressed, whole or not at all.
/// Throws Error(io) naming the file. Values must already fit the depth: see lightmap/half_range.h.
void write_exr(const std::filesystem::path& file, const LayeredImage& image, Depth depth);

/// Reads every channel of a file (EXR or any other format of OpenImageIO) into layers.
/// Throws Error(io) where the file cannot be opened, Error(invalid_input) where it is truncated or damaged.
[[nodiscard]] LayeredImage read_image(const std::filesystem::path& file);

}  // namespace rnmbake
