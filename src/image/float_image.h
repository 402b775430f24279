// image/float_image.h - a picture in memory: 32-bit floats, interleaved channels, row 0 on top.
#pragma once

#include "base/math.h"

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace rnmbake {

/// Row 0 is the top row, as in an EXR. A texel (x, y) has the UV (x + 0.5) / width, 1 - (y + 0.5) / height:
/// Blender's images start at the bottom and are flipped where they are read.
class FloatImage {
 public:
  FloatImage() = default;
  FloatImage(int width, int height, int channels)
      : width_(width),
        height_(height),
        channels_(channels),
        data_(static_cast<std::size_t>(width) * height * channels, 0.0F) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] std::size_t texels() const { return static_cast<std::size_t>(width_) * height_; }
  [[nodiscard]] bool empty() const { return data_.empty(); }

  [[nodiscard]] std::span<float> texel(int x, int y) { return {&data_[offset(x, y)], size_t(channels_)}; }
  [[nodiscard]] std::span<const float> texel(int x, int y) const {
    return {&data_[offset(x, y)], size_t(channels_)};
  }
  [[nodiscard]] std::vector<float>& data() { return data_; }
  [[nodiscard]] const std::vector<float>& data() const { return data_; }

 private:
  [[nodiscard]] std::size_t offset(int x, int y) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_);
    return (static_cast<std::size_t>(y) * width_ + x) * channels_;
  }

  int width_ = 0, height_ = 0, channels_ = 0;
  std::vector<float> data_;
};

/// The first three channels of a texel: a colour or a vector.
[[nodiscard]] inline Vec3 vec3_at(const FloatImage& image, int x, int y) {
  const auto texel = image.texel(x, y);
  return {texel[0], texel[1], texel[2]};
}

inline void set_vec3(FloatImage& image, int x, int y, const Vec3& value) {
  const auto texel = image.texel(x, y);
  for (int c = 0; c < 3; ++c) texel[static_cast<std::size_t>(c)] = value[c];
}

}  // namespace rnmbake
