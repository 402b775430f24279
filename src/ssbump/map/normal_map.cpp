#include "ssbump/map/normal_map.h"

#include "base/error.h"
#include "base/math.h"
#include "image/channels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace rnmbake {
namespace {

constexpr float shortest = 0.1F;
constexpr double most_below = 0.01;  // share of normals with z < 0; steep maps have a few

/// How one texel of this picture becomes a vector.
class Unpacking {
 public:
  Unpacking(const VectorSource& source, const NormalMapFormat& format)
      : places_(source.places), sign_(format.y_down ? -1.0F : 1.0F) {
    if (source.is_signed) return;
    scale_ = 2;
    offset_ = -1;
  }

  [[nodiscard]] Vec3 vector(std::span<const float> texel) const {
    const auto at = [&](std::size_t i) {
      return scale_ * texel[static_cast<std::size_t>(places_[i])] + offset_;
    };
    const float x = at(0), y = sign_ * at(1);
    return {x, y, places_.size() > 2 ? at(2) : std::sqrt(std::max(0.0F, 1 - x * x - y * y))};
  }

 private:
  std::vector<int> places_;
  float sign_, scale_ = 1, offset_ = 0;
};

void check_vector(const Vec3& vector, int x, int y, const std::string& file) {
  const float length = vector.length();
  if (!std::isfinite(length))
    fail(ExitCode::invalid_input, "{}: texel ({}, {}) is not finite; mend the normal map", file, x, y);
  if (length < shortest) {
    fail(ExitCode::invalid_input,
         "{}: texel ({}, {}) is a normal of length {:.3f}; is this a tangent-space normal map?", file, x, y,
         length);
  }
}

}  // namespace

FloatImage unit_normals(const LayeredImage& picture, const std::string& file, const NormalMapFormat& format) {
  const VectorSource source = vector_source(picture, file, format.two_channel);
  const Unpacking unpacking(source, format);
  const FloatImage& pixels = source.layer->pixels;
  FloatImage normals(pixels.width(), pixels.height(), 3);
  std::size_t below = 0;
  for (int y = 0; y < normals.height(); ++y) {
    for (int x = 0; x < normals.width(); ++x) {
      const Vec3 vector = unpacking.vector(pixels.texel(x, y));
      check_vector(vector, x, y, file);
      if (vector.z < 0) ++below;
      const Vec3 normal = unit(vector);
      std::ranges::copy(std::array{normal.x, normal.y, normal.z}, normals.texel(x, y).begin());
    }
  }
  const double share = double(below) / double(normals.texels());
  if (share > most_below) {
    fail(ExitCode::invalid_input,
         "{}: {:.0f} % of its normals point below the surface; a tangent-space normal map is needed", file,
         100 * share);
  }
  return normals;
}

}  // namespace rnmbake
