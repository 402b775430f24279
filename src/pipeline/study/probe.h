// pipeline/study/probe.h - a picture of the light around a point as distant sources, and what encodings of
// the whole sphere make of it.
#pragma once

#include "encoding/distant_light.h"
#include "image/float_image.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Direction of the middle of the picture's texel, as Blender takes an equirectangular world: row 0 is z, the
/// middle column x, and columns run towards -y.
[[nodiscard]] Vec3 probe_direction(int x, int y, int width, int height);

/// Sums above which a probe's texels are not told apart: 1.4 degrees.
inline constexpr int most_probe_rows = 128;

/// The first layer with three channels. Throws as read_image(), and Error(invalid_input) for values that are
/// no numbers, or beyond 1e15.
[[nodiscard]] FloatImage read_colours(const std::filesystem::path& file);

/// A picture of radiance in latitudes and longitudes, twice as wide as high. Throws as read_colours(),
/// and Error(invalid_input) for other shapes.
[[nodiscard]] FloatImage read_probe(const std::filesystem::path& file);

/// Its texels as sources, summed into `rows` rows where there are more.
[[nodiscard]] DistantLight probe_light(const FloatImage& picture, int rows = most_probe_rows);

struct ProbeErrors {
  std::string label;
  int numbers = 0;                    // for each colour
  double by_texel = 0, by_angle = 0;  // RMS of E/pi: texels of the picture count alike, or by solid angle
  double bias = 0;                    // mean error, by solid angle
};

struct ProbeTable {
  std::vector<ProbeErrors> errors;
  double mean = 0;  // E/pi over the sphere
};

/// E/pi of the whole sphere's light at normals that are the texels' middles of `rows` rows, against what each
/// encoding decodes there. by_texel is the measure of Probulator's reports
/// (https://github.com/kayru/Probulator), whose SH values are cut off below 0, too.
[[nodiscard]] ProbeTable study_probe_sphere(const DistantLight& light, int rows = most_probe_rows);

/// As a text table, as Markdown, or as JSON.
[[nodiscard]] std::string probe_table(const ProbeTable& table);
[[nodiscard]] std::string probe_markdown(const ProbeTable& table);
[[nodiscard]] nlohmann::json probe_json(const ProbeTable& table);

}  // namespace rnmbake
