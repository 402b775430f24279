// sampling/cosine_lobes.h - directions over a face for several clamped cosines at once, and their density.
#pragma once

#include "base/math.h"
#include "sampling/maps.h"
#include "sampling/orthonormal_basis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rnmbake {

/// An equal mixture of cosine lobes around several axes, the part below the face mirrored up; with `uniform`,
/// the uniform density over the hemisphere is one component more. Bounds the cosine of each axis:
/// max(0, D . axis) <= components x pi x pdf(D).
class CosineLobes {
 public:
  static constexpr std::size_t most = 6;

  CosineLobes() = default;
  explicit CosineLobes(const Vec3& face, bool uniform = false) : face_(face), uniform_(uniform) {}
  void add(const Vec3& axis) {
    axes_[count_] = axis;
    slopes_[count_++] = 2 * axis.dot(face_);
  }

  [[nodiscard]] Vec3 sample(float choice, const Vec2& u) const {
    const auto lobe = std::min(static_cast<std::size_t>(choice * float(components())), components() - 1);
    if (lobe >= count_) return OrthonormalBasis(face_).to_world(uniform_hemisphere_polar(u));
    const Vec3 direction = unit(OrthonormalBasis(axes_[lobe]).to_world(cosine_hemisphere_polar(u)));
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
    return (sum + (uniform_ ? 0.5F : 0.0F)) / (static_cast<float>(pi) * float(components()));
  }

 private:
  [[nodiscard]] std::size_t components() const { return count_ + (uniform_ ? 1 : 0); }

  Vec3 face_;
  bool uniform_ = false;
  std::size_t count_ = 0;
  std::array<Vec3, most> axes_{};
  std::array<float, most> slopes_{};  // 2 axis . face: what mirroring subtracts for each unit of height
};

}  // namespace rnmbake
