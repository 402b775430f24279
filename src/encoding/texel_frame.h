// encoding/texel_frame.h - a texel's tangent space as seen from the space that its layers are kept in.
#pragma once

#include "base/math.h"

namespace rnmbake {

/// Tangent, bitangent and normal of a texel, orthonormal, in the space of the layers (mostly the world). As
/// it stands: the layers are kept in tangent space.
struct TexelFrame {
  Vec3 tangent{1, 0, 0}, bitangent{0, 1, 0}, normal{0, 0, 1};

  /// A tangent-space vector in the space of the layers.
  template <typename T>
  [[nodiscard]] Imath::Vec3<T> stored(const Imath::Vec3<T>& v) const {
    return Imath::Vec3<T>(tangent) * v.x + Imath::Vec3<T>(bitangent) * v.y + Imath::Vec3<T>(normal) * v.z;
  }
};

}  // namespace rnmbake
