#include "ssbump/map/slope_curl.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr float least_slope_z = 0.01F;

/// The derivatives that are equal on a surface.
struct Twist {
  double p_by_y = 0, q_by_x = 0;
};

/// The walk around squares of `scale` texels. Each side is the mean of two neighbouring lines of texels, so
/// that slopes made by central differences cancel to the last bit, at every scale; at 1 it is central
/// differences.
class Squares {
 public:
  Squares(const FloatImage& normals, int scale) : normals_(normals), scale_(scale) {}

  /// Of the square whose sides lie between columns `x` and `x + 1`, `x + scale` and `x + scale + 1`; rows
  /// alike.
  [[nodiscard]] Twist twist(int x, int y) const {
    Twist twist;
    for (int i = 1; i <= scale_; ++i) {
      twist.p_by_y += p(x + i, y) + p(x + i, y + 1) - p(x + i, y + scale_) - p(x + i, y + scale_ + 1);
      twist.q_by_x += q(x + scale_, y + i) + q(x + scale_ + 1, y + i) - q(x, y + i) - q(x + 1, y + i);
    }
    const double over = 1 / (2.0 * scale_ * scale_);  // two lines each, and the square's area
    return {twist.p_by_y * over, twist.q_by_x * over};
  }

 private:
  /// Minus the normal's x (0) or y (1) over its z, wrapped around.
  [[nodiscard]] double slope(int x, int y, std::size_t axis) const {
    const auto n = normals_.texel(x % normals_.width(), y % normals_.height());
    return -n[axis] / std::max(n[2], least_slope_z);
  }
  [[nodiscard]] double p(int x, int y) const { return slope(x, y, 0); }
  [[nodiscard]] double q(int x, int y) const { return slope(x, y, 1); }

  const FloatImage& normals_;
  int scale_;
};

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
  const Squares squares(normals, options.scale);
  const int beyond = options.border == Border::wrap ? 0 : options.scale + 1;
  SlopeCurl result;
  Sums sums;
  for (int y = 0; y < normals.height() - beyond; y += options.scale) {
    for (int x = 0; x < normals.width() - beyond; x += options.scale) {
      const Twist twist = squares.twist(x, y);
      sums.add(twist, options.bound);
      const double curl = std::abs(twist.p_by_y - twist.q_by_x);
      if (curl <= result.worst) continue;
      result.worst = curl;
      result.worst_x = (x + (options.scale + 1) / 2) % normals.width();
      result.worst_y = (y + (options.scale + 1) / 2) % normals.height();
    }
  }
  sums.put_into(result);
  return result;
}

}  // namespace rnmbake
