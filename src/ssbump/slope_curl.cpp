#include "ssbump/slope_curl.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr float kLeastZ = 0.01F;

/// dh/dx and dh/dy, means over squares of `scale` texels.
FloatImage slopes_of(const FloatImage& normals, int scale) {
  FloatImage slopes(normals.width() / scale, normals.height() / scale, 2);
  const float share = 1 / (static_cast<float>(scale) * static_cast<float>(scale));
  for (int y = 0; y < slopes.height() * scale; ++y) {
    for (int x = 0; x < slopes.width() * scale; ++x) {
      const auto n = normals.texel(x, y);
      const auto sum = slopes.texel(x / scale, y / scale);
      for (std::size_t axis = 0; axis < 2; ++axis) sum[axis] -= share * n[axis] / std::max(n[2], kLeastZ);
    }
  }
  return slopes;
}

/// The derivatives that are equal on a surface, wrapped around.
struct Twist {
  double p_by_y = 0, q_by_x = 0;
};

Twist twist_at(const FloatImage& slopes, int x, int y, int scale) {
  const auto slope = [&](int at_x, int at_y, std::size_t axis) -> double {
    return slopes.texel((at_x + slopes.width()) % slopes.width(),
                        (at_y + slopes.height()) % slopes.height())[axis];
  };
  const double across = 2.0 * scale;
  return {(slope(x, y - 1, 0) - slope(x, y + 1, 0)) / across,  // rows run down
          (slope(x + 1, y, 1) - slope(x - 1, y, 1)) / across};
}

/// Sums over all places.
class Sums {
 public:
  void add(const Twist& twist, double bound) {
    const double curl = twist.p_by_y - twist.q_by_x, flipped = twist.p_by_y + twist.q_by_x;
    curl_ += curl * curl;
    flipped_ += flipped * flipped;
    derivatives_ += twist.p_by_y * twist.p_by_y + twist.q_by_x * twist.q_by_x;
    if (std::abs(curl) > bound) ++above_;
    ++places_;
  }
  void put_into(SlopeCurl& result) const {
    result.places = places_;
    if (places_ == 0) return;
    result.rms = std::sqrt(curl_ / static_cast<double>(places_));
    result.share_above = static_cast<double>(above_) / static_cast<double>(places_);
    if (derivatives_ == 0) return;
    result.relative = std::sqrt(curl_ / derivatives_);
    result.relative_flipped = std::sqrt(flipped_ / derivatives_);
  }

 private:
  double curl_ = 0, flipped_ = 0, derivatives_ = 0;  // squares
  std::size_t places_ = 0, above_ = 0;
};

}  // namespace

SlopeCurl slope_curl(const FloatImage& normals, const SlopeCurlOptions& options) {
  const FloatImage slopes = slopes_of(normals, options.scale);
  const int margin = options.border == Border::wrap ? 0 : 1;
  SlopeCurl result;
  Sums sums;
  for (int y = margin; y < slopes.height() - margin; ++y) {
    for (int x = margin; x < slopes.width() - margin; ++x) {
      const Twist twist = twist_at(slopes, x, y, options.scale);
      sums.add(twist, options.bound);
      const double curl = std::abs(twist.p_by_y - twist.q_by_x);
      if (curl <= result.worst) continue;
      result.worst = curl;
      result.worst_x = x * options.scale + options.scale / 2;
      result.worst_y = y * options.scale + options.scale / 2;
    }
  }
  sums.put_into(result);
  return result;
}

}  // namespace rnmbake
