#include "lightmap/frames.h"

namespace rnmbake {

std::optional<TexelFrame> frame_at(const Layer* tangent, const Layer* normal, int x, int y, Green green) {
  if (tangent == nullptr || normal == nullptr) return std::nullopt;
  const auto t = tangent->pixels.texel(x, y), n = normal->pixels.texel(x, y);
  if (t.size() < 3 || n.size() < 3) return std::nullopt;
  const Vec3 up(n[0], n[1], n[2]), along(t[0], t[1], t[2]);
  const Vec3 across = up.cross(along);
  const float size = across.length() * up.length();
  if (!(size > 1e-6F)) return std::nullopt;
  const Vec3 z = unit(up), y_right = unit(across), x_axis = y_right.cross(z);
  const bool is_mirrored = t.size() > 3 && t[3] < 0;
  return TexelFrame{x_axis, is_mirrored == (green == Green::y_up) ? -y_right : y_right, z};
}

}  // namespace rnmbake
