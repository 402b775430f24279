#include "lightmap/frames.h"

namespace rnmbake {

std::optional<TexelFrame> frame_at(const FloatImage& tangent, const FloatImage& normal, int x, int y,
                                   Green green) {
  if (tangent.channels() < 3 || normal.channels() < 3) return std::nullopt;
  const Vec3 up = vec3_at(normal, x, y), along = vec3_at(tangent, x, y);
  const Vec3 across = up.cross(along);
  const float size = across.length() * up.length();
  if (!(size > 1e-6F)) return std::nullopt;
  const Vec3 z = unit(up), y_right = unit(across), x_axis = y_right.cross(z);
  const bool is_mirrored = tangent.channels() > 3 && tangent.texel(x, y)[3] < 0;
  return TexelFrame{x_axis, is_mirrored == (green == Green::y_up) ? -y_right : y_right, z};
}

}  // namespace rnmbake
