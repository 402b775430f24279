// sampling/cosine_lobes.h - chooses directions over a face for several cosine lobes at once.
#pragma once

#include "base/math.h"
#include "sampling/warps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rnmbake {

/// Around `n` with pdf cos/pi (Malley's method).
[[nodiscard]] inline Vec3 cosine_direction(const Vec3& n, const Vec2& u) {
  const float r = std::sqrt(u.x), phi = static_cast<float>(2 * pi) * u.y;
  const Vec3 local(r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0F, 1 - u.x)));
  return unit(Axes(n).to_world(local));
}

/// An equal mixture of cosine lobes, the part under the face mirrored up; with `uniform` one lobe more that
/// is the same in all directions. Whatever max(0, D . lobe) weighs is at most lobes x pi times the pdf.
class Lobes {
 public:
  static constexpr std::size_t most = 6;

  Lobes() = default;
  explicit Lobes(const Vec3& face, bool uniform = false) : face_(face), uniform_(uniform) {}
  void add(const Vec3& axis) {
    axes_[count_] = axis;
    slopes_[count_++] = 2 * axis.dot(face_);
  }

  [[nodiscard]] Vec3 sample(float choice, const Vec2& u) const {
    const auto lobe = std::min(static_cast<std::size_t>(choice * float(all())), all() - 1);
    if (lobe >= count_) return uniform_direction(u);
    const Vec3 direction = cosine_direction(axes_[lobe], u);
    const float height = direction.dot(face_);
    return height < 0 ? direction - face_ * (2 * height) : direction;
  }

  /// Per solid angle; 0 under the face.
  [[nodiscard]] float pdf(const Vec3& direction) const {
    const float height = direction.dot(face_);
    if (!(height > 0)) return 0;
    float sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const float up = direction.dot(axes_[i]);
      sum += std::max(0.0F, up) + std::max(0.0F, up - height * slopes_[i]);
    }
    return (sum + (uniform_ ? 0.5F : 0.0F)) / (static_cast<float>(pi) * float(all()));
  }

 private:
  [[nodiscard]] std::size_t all() const { return count_ + (uniform_ ? 1 : 0); }
  [[nodiscard]] Vec3 uniform_direction(const Vec2& u) const {
    const float z = u.x, r = std::sqrt(std::max(0.0F, 1 - z * z)), phi = static_cast<float>(2 * pi) * u.y;
    return Axes(face_).to_world({r * std::cos(phi), r * std::sin(phi), z});
  }

  Vec3 face_;
  bool uniform_ = false;
  std::size_t count_ = 0;
  std::array<Vec3, most> axes_{};
  std::array<float, most> slopes_{};  // 2 axis . face: what mirroring takes away for each unit of height
};

}  // namespace rnmbake
