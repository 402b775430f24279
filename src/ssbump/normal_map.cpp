#include "ssbump/normal_map.h"

#include "base/error.h"
#include "base/math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace rnmbake {
namespace {

constexpr float kShortest = 0.1F;
constexpr double kMostBelow = 0.01;  // share of normals with z < 0; steep maps have a few

const Layer& normal_layer(const LayeredImage& picture, const std::string& file, bool two_channel) {
  for (const char* name : {"", "normal"}) {
    const Layer* layer = picture.find(name);
    if (layer == nullptr || layer->pixels.channels() < 2) continue;
    if (two_channel || layer->channels[1] != "A") return *layer;
  }
  fail(ExitCode::invalid_input, "{} holds no normals: two or three plain channels are needed", file);
}

/// How one texel of this picture becomes a vector.
class Unpacking {
 public:
  Unpacking(const Layer& layer, const NormalMapFormat& format)
      : has_z_(!format.two_channel && layer.pixels.channels() >= 3 && layer.channels[2] != "A"),
        sign_(format.y_down ? -1.0F : 1.0F) {
    const auto is_negative = [](float value) { return value < 0; };
    if (layer.channels[0] != "X" && std::ranges::none_of(layer.pixels.data(), is_negative)) {
      scale_ = 2;
      offset_ = -1;
    }
  }

  [[nodiscard]] Vec3 vector(std::span<const float> texel) const {
    const auto at = [&](std::size_t i) { return scale_ * texel[i] + offset_; };
    const float x = at(0), y = sign_ * at(1);
    return {x, y, has_z_ ? at(2) : std::sqrt(std::max(0.0F, 1 - x * x - y * y))};
  }

 private:
  bool has_z_;
  float sign_, scale_ = 1, offset_ = 0;
};

void check_vector(const Vec3& vector, int x, int y, const std::string& file) {
  const float length = vector.length();
  if (!std::isfinite(length))
    fail(ExitCode::invalid_input, "{}: texel ({}, {}) is not finite; mend the normal map", file, x, y);
  if (length < kShortest) {
    fail(ExitCode::invalid_input,
         "{}: texel ({}, {}) is a normal of length {:.3f}; is this a tangent-space normal map?", file, x, y,
         length);
  }
}

}  // namespace

FloatImage unit_normals(const LayeredImage& picture, const std::string& file, const NormalMapFormat& format) {
  const Layer& layer = normal_layer(picture, file, format.two_channel);
  const Unpacking unpacking(layer, format);
  FloatImage normals(layer.pixels.width(), layer.pixels.height(), 3);
  std::size_t below = 0;
  for (int y = 0; y < normals.height(); ++y) {
    for (int x = 0; x < normals.width(); ++x) {
      const Vec3 vector = unpacking.vector(layer.pixels.texel(x, y));
      check_vector(vector, x, y, file);
      if (vector.z < 0) ++below;
      const Vec3 normal = unit(vector);
      std::ranges::copy(std::array{normal.x, normal.y, normal.z}, normals.texel(x, y).begin());
    }
  }
  const double share = double(below) / double(normals.texels());
  if (share > kMostBelow) {
    fail(ExitCode::invalid_input,
         "{}: {:.0f} % of its normals point below the surface; a tangent-space normal map is needed", file,
         100 * share);
  }
  return normals;
}

}  // namespace rnmbake
