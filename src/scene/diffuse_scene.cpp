#include "scene/diffuse_scene.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

const SurfaceMaterial& DiffuseScene::material(std::size_t object, std::size_t slot) const {
  const std::vector<int>& slots = object_materials[object];
  return materials[static_cast<std::size_t>(slots[std::min(slot, slots.size() - 1)])];
}

Vec2 world_uv(const Vec3& direction) {
  const auto [x, y, z] = Vec3d(direction);
  const double u = 0.5 - std::atan2(y, x) / (2 * pi);
  const double v = 0.5 + std::atan2(z, std::hypot(x, y)) / pi;
  return {static_cast<float>(u), static_cast<float>(v)};
}

Vec3 world_direction(const Vec2& uv) {
  const double azimuth = (0.5 - double{uv.x}) * 2 * pi, elevation = (double{uv.y} - 0.5) * pi;
  return Vec3(Vec3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                    std::sin(elevation)));
}

}  // namespace rnmbake
