#include "image/display_png.h"

#include "image/oiio_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rnmbake {

float srgb_encode(float linear) {
  if (!(linear > 0)) return 0;
  const float clamped = std::min(linear, 1.0F);
  return clamped <= 0.0031308F ? 12.92F * clamped : 1.055F * std::pow(clamped, 1 / 2.4F) - 0.055F;
}

float srgb_decode(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

void write_display_png(const std::filesystem::path& file, const FloatImage& image, float exposure) {
  const float gain = std::exp2(exposure);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.data().size());
  for (const float value : image.data())
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * srgb_encode(gain * value))));
  OIIO::ImageSpec spec(image.width(), image.height(), image.channels(), OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_encoded(file, "png", spec,
                [&](OIIO::ImageOutput& out) { return out.write_image(OIIO::TypeDesc::UINT8, bytes.data()); });
}

}  // namespace rnmbake
