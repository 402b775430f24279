#include "ssbump/generate/albedo.h"

#include "base/error.h"
#include "image/channels.h"
#include "image/display_png.h"
#include "image/picture_rows.h"
#include "ssbump/map/weights.h"

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

/// Three channels, or one of grey.
std::vector<int> colours_of(const std::vector<std::string>& names, const std::string& file) {
  auto colour = colour_channels(names, file, "save the colours as a picture of their own");
  if (!colour.empty()) return colour;
  if (names.size() == 1) return {0};
  for (const char* grey : {"Y", "I"}) {
    auto found = places_of(names, grey);
    if (!found.empty() && places_of(names, "XY").empty()) return found;
  }
  fail(ExitCode::invalid_input, "{} holds no colours: its channels are {}; give a picture with R, G and B",
       file, listed(names));
}

float luminance(const float* texel, const std::vector<int>& colour, bool is_srgb) {
  const auto linear = [&](std::size_t c) { return linear_of(texel[colour[c]], is_srgb); };
  if (colour.size() < 3) return linear(0);
  return 0.2126F * linear(0) + 0.7152F * linear(1) + 0.0722F * linear(2);
}

}  // namespace

FloatImage read_albedo(const std::filesystem::path& file, int width, int height) {
  PictureReader reader(file);
  const PictureFacts& facts = reader.facts();
  if (facts.width != width || facts.height != height) {
    fail(ExitCode::invalid_input, "{} is {}x{} where the heights are {}x{}; scale it to their size",
         file.string(), facts.width, facts.height, width, height);
  }
  const std::vector<int> colour = colours_of(facts.channels, file.string());
  const int channels = static_cast<int>(facts.channels.size());
  FloatImage albedo(width, height, 1);
  std::vector<float> row(static_cast<std::size_t>(width) * channels);
  for (int y = 0; y < height; ++y) {
    reader.read(y, y + 1, 0, channels, row);
    for (int x = 0; x < width; ++x)
      albedo.texel(x, y)[0] =
          luminance(&row[static_cast<std::size_t>(x) * channels], colour, facts.is_integer);
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
