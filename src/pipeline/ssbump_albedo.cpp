#include "pipeline/ssbump_albedo.h"

#include "base/error.h"
#include "image/display_png.h"
#include "image/picture_rows.h"
#include "ssbump/weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rnmbake {
namespace {

float linear_of(float value, bool is_srgb) {
  if (!(value > 0)) return 0;  // NaN too
  return std::min(is_srgb ? srgb_decode(value) : value, 1.0F);
}

float luminance(const float* texel, int channels, bool is_srgb) {
  if (channels < 3) return linear_of(texel[0], is_srgb);
  return 0.2126F * linear_of(texel[0], is_srgb) + 0.7152F * linear_of(texel[1], is_srgb) +
         0.0722F * linear_of(texel[2], is_srgb);
}

}  // namespace

FloatImage read_albedo(const std::filesystem::path& file, int width, int height) {
  PictureReader reader(file);
  const PictureFacts& facts = reader.facts();
  if (facts.width != width || facts.height != height) {
    fail(ExitCode::invalid_input, "{} is {}x{} where the heights are {}x{}; scale it to their size",
         file.string(), facts.width, facts.height, width, height);
  }
  const int channels = facts.channels.size() >= 3 ? 3 : 1;
  FloatImage albedo(width, height, 1);
  std::vector<float> row(static_cast<std::size_t>(width) * channels);
  for (int y = 0; y < height; ++y) {
    reader.read(y, y + 1, 0, channels, row);
    for (int x = 0; x < width; ++x)
      albedo.texel(x, y)[0] =
          luminance(&row[static_cast<std::size_t>(x) * channels], channels, facts.is_integer);
  }
  return albedo;
}

void modulate_rows(FloatImage& rows, const FloatImage& albedo, int first_row) {
  for (int y = 0; y < rows.height(); ++y) {
    for (int x = 0; x < rows.width(); ++x) {
      const float share = albedo.texel(x, first_row + y)[0];
      for (int c = 0; c < SsbumpWeights::ambient; ++c) rows.texel(x, y)[static_cast<std::size_t>(c)] *= share;
    }
  }
}

}  // namespace rnmbake
