#include "image/light_pictures.h"

#include "base/files.h"
#include "image/layered_exr.h"

#include <cmath>
#include <cstddef>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Over some powers of two.
FloatImage noise(int width, int height, float least, float most) {
  FloatImage image(width, height, 3);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(std::log2(least), std::log2(most));
  for (float& value : image.data()) value = std::exp2(exponent(random));
  return image;
}

/// Of what is seen of a picture, for each texel relative to its brightest channel: the largest error, and the
/// mean with its sign.
struct Errors {
  double largest = 0, mean = 0;
};
Errors errors(const FloatImage& seen, const FloatImage& image) {
  Errors found;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float most = max_channel(vec3_at(image, x, y));
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = double(seen.texel(x, y)[c] - image.texel(x, y)[c]) / most;
        found.largest = std::max(found.largest, std::abs(error));
        found.mean += error / double(image.data().size());
      }
    }
  }
  return found;
}

TEST(Hdr, IsRoundedAndNotCutOff) {
  const TempFolder folder;
  const FloatImage image = noise(101, 40, 1e-4F, 1e4F);
  write_hdr(folder.path() / "light.hdr", image);
  const Errors found = errors(read_image(folder.path() / "light.hdr").layers.front().pixels, image);
  EXPECT_LT(found.largest, 1.0 / 256 * 1.001);
  EXPECT_LT(std::abs(found.mean), 1e-4);  // cut off: -1/512 or so
}

TEST(Hdr, HasNothingBelowZero) {
  const TempFolder folder;
  FloatImage image(4, 1, 3);
  set_vec3(image, 1, 0, {-1, 2, 0});
  set_vec3(image, 2, 0, {std::nanf(""), 0, 0});
  set_vec3(image, 3, 0, {0.9999F, 0.5F, 0.25F});
  write_hdr(folder.path() / "light.hdr", image);
  const FloatImage seen = read_image(folder.path() / "light.hdr").layers.front().pixels;
  EXPECT_EQ(vec3_at(seen, 0, 0), Vec3(0, 0, 0));
  EXPECT_EQ(vec3_at(seen, 1, 0), Vec3(0, 2, 0));
  EXPECT_EQ(vec3_at(seen, 2, 0), Vec3(0, 0, 0));
  EXPECT_EQ(vec3_at(seen, 3, 0), Vec3(1, 0.5F, 0.25F));
}

TEST(Rgbm, KeepsLightWithinItsRange) {
  const TempFolder folder;
  const FloatImage image = noise(64, 64, 1e-2F, 34);
  write_rgbm(folder.path() / "light.png", image);
  const Errors found = errors(read_rgbm(folder.path() / "light.png"), image);
  EXPECT_LT(found.largest, 0.02);
  EXPECT_LT(std::abs(found.mean), 1e-3);
}

TEST(Rgbm, IsWhatUnityDecodes) {
  const TempFolder folder;
  FloatImage image(3, 1, 3);
  set_vec3(image, 0, 0, {34.493242F, 0, 0});
  set_vec3(image, 1, 0, {1e6F, -1, 0});
  write_rgbm(folder.path() / "light.png", image);
  const FloatImage stored = read_image(folder.path() / "light.png").layers.front().pixels;
  ASSERT_EQ(stored.channels(), 4);
  for (int x = 0; x < 2; ++x) {  // the largest value; what is beyond it
    EXPECT_EQ(vec3_at(stored, x, 0), Vec3(1, 0, 0));
    EXPECT_EQ(stored.texel(x, 0)[3], 1);
  }
  EXPECT_EQ(vec3_at(stored, 2, 0), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace rnmbake
