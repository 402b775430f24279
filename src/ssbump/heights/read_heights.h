// ssbump/heights/read_heights.h - a picture as a height field: channel, scale and sign.
#pragma once

#include "ssbump/heights/height_field.h"

#include <filesystem>
#include <optional>
#include <string>

namespace rnmbake {

struct HeightOptions {
  std::string channel;  // name, "red" .. "alpha", "luminance", or number from 0; empty: luminance of R, G, B,
                        // else the only one beside alpha
  bool invert = false;  // the file holds depths: large values are low
  /// Height in texels of a value of 1 (in integer formats the full range). None given: sqrt(width height) /
  /// 32 for integers, 1 for floats.
  std::optional<double> texels;
  WrapMode x = WrapMode::wrap, y = WrapMode::wrap;
};

struct ReadHeights {
  HeightField field;
  std::string channel;            // that was read
  bool is_integer = false;        // the file's values are shares of its type's largest
  double texels = 0;              // that a value of 1 is high
  float lowest = 0, highest = 0;  // as the file stores them
};

/// Reads a few rows at a time, so that only the heights stay in memory. Throws Error(usage) for a missing
/// channel, naming the file's; Error(invalid_input) where the channels' names are ambiguous, and for NaN and
/// infinity, naming the texel; and as PictureReader.
[[nodiscard]] ReadHeights read_heights(const std::filesystem::path& file, const HeightOptions& options);

}  // namespace rnmbake
