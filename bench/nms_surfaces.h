// bench/nms_surfaces.h - the surfaces that normal mapping shadows are measured on.
#pragma once

#include "image/float_image.h"
#include "ssbump/heights/height_field.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// A surface, and the normals that a normal map of it has.
struct Case {
  std::string name;
  HeightField field;
  FloatImage normals;  // that are lit
  FloatImage walked;   // that shadows come from
};

/// Made by formulas, with the normals of their heights: flat, waves, noise, grooves, domes, blocks.
[[nodiscard]] std::vector<Case> generated_surfaces();

/// Heights and normals that somebody published together. The heights' scale is not said with them: it is the
/// one with which their slopes fit the normals best.
struct Published {
  Case own, theirs;  // normals from the heights, and those that came with them
  double correlation = 0;
};

[[nodiscard]] Published published(const std::filesystem::path& heights_file, std::size_t channel,
                                  const std::filesystem::path& normals_file, const std::string& name,
                                  float sign);

[[nodiscard]] double slope_rms(const Case& one);

[[nodiscard]] FloatImage flipped_green(FloatImage normals);
[[nodiscard]] FloatImage eight_bit(FloatImage normals);

}  // namespace rnmbake
