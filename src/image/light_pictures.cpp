#include "image/light_pictures.h"

#include "image/display_png.h"
#include "image/oiio_bytes.h"
#include "image/picture_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rnmbake {
namespace {

/// The values whose mantissas are whole numbers. The library cuts off what follows the point, so that they
/// lie a little above.
Vec3 with_whole_mantissas(const Vec3& colour) {
  const float most = max_channel(colour);
  if (!(most > 1e-32F)) return {0, 0, 0};
  const int shared = std::ilogb(most) + 1;
  constexpr int mantissa_bits = 8;
  const bool carries = std::nearbyint(std::ldexp(most, mantissa_bits - shared)) > 255;
  const int scale = mantissa_bits - shared - (carries ? 1 : 0);
  Vec3 whole;
  for (int c = 0; c < 3; ++c)
    whole[c] = std::ldexp(std::nearbyint(std::ldexp(std::max(0.0F, colour[c]), scale)) + 0.25F, -scale);
  return whole;
}

float clamped(float value, float most) {
  return std::min(std::max(0.0F, value), most);
}

}  // namespace

void write_hdr(const std::filesystem::path& file, const FloatImage& image) {
  FloatImage whole(image.width(), image.height(), 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) set_vec3(whole, x, y, with_whole_mantissas(vec3_at(image, x, y)));
  const OIIO::ImageSpec spec(image.width(), image.height(), 3, OIIO::TypeDesc::FLOAT);
  write_encoded(file, "hdr", spec, [&](OIIO::ImageOutput& out) {
    return out.write_image(OIIO::TypeDesc::FLOAT, whole.data().data());
  });
}

void write_rgbm(const std::filesystem::path& file, const FloatImage& image) {
  std::vector<float> coded;
  coded.reserve(image.texels() * 4);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float most = clamped(max_channel(vec3_at(image, x, y)), rgbm_range);
      const float alpha = std::max(1.0F, std::ceil(255 * std::pow(most / rgbm_range, 1 / rgbm_gamma))) / 255;
      const float scale = rgbm_range * std::pow(alpha, rgbm_gamma);
      for (const float value : image.texel(x, y))
        coded.push_back(srgb_encode(clamped(value, rgbm_range) / scale));
      coded.push_back(alpha);
    }
  }
  PictureWriter writer(file, {image.width(), image.height(), {"R", "G", "B", "A"}, Storage::u8, {}});
  writer.write(0, image.height(), coded);
  writer.commit();
}

FloatImage read_rgbm(const std::filesystem::path& file) {
  PictureReader reader(file);
  const int width = reader.facts().width, height = reader.facts().height;
  FloatImage coded(width, height, 4), light(width, height, 3);
  reader.read(0, height, 0, 4, coded.data());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto texel = coded.texel(x, y);
      const float scale = rgbm_range * std::pow(texel[3], rgbm_gamma);
      for (std::size_t c = 0; c < 3; ++c) light.texel(x, y)[c] = scale * srgb_decode(texel[c]);
    }
  }
  return light;
}

}  // namespace rnmbake
