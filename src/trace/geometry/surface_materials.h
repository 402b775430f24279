// trace/geometry/surface_materials.h - albedo, emission and transmittance at a surface point.
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"

#include <cstdint>

namespace rnmbake {

/// Bilinear lookup, clamped at the borders, v up: Cycles' image texture with Linear and EXTEND.
[[nodiscard]] Vec3 lookup(const Texture& picture, const Vec2& uv);

class SurfaceMaterials {
 public:
  explicit SurfaceMaterials(const DiffuseScene& scene) : scene_(&scene) {}

  /// In [0, 1].
  [[nodiscard]] Vec3 albedo(std::uint32_t material, const Vec2& uv) const {
    const SurfaceMaterial& it = scene_->materials[material];
    return it.albedo_picture < 0 ? it.albedo : unit(lookup(scene_->pictures[it.albedo_picture], uv));
  }
  /// In [0, 1].
  [[nodiscard]] Vec3 transmittance(std::uint32_t material, const Vec2& uv) const {
    const SurfaceMaterial& it = scene_->materials[material];
    if (it.transmittance_picture < 0) return it.transmittance;
    return unit(lookup(scene_->pictures[it.transmittance_picture], uv));
  }
  /// Whether any of it transmits light.
  [[nodiscard]] bool see_through(std::uint32_t material) const {
    return scene_->materials[material].see_through();
  }
  /// Radiance.
  [[nodiscard]] Vec3 emission(std::uint32_t material, const Vec2& uv) const {
    const SurfaceMaterial& it = scene_->materials[material];
    return it.emission_picture < 0 ? it.emission : lookup(scene_->pictures[it.emission_picture], uv);
  }
  [[nodiscard]] bool emits(std::uint32_t material) const {
    const SurfaceMaterial& it = scene_->materials[material];
    return it.emission_picture >= 0 || it.emission != Vec3(0, 0, 0);
  }

 private:
  [[nodiscard]] static Vec3 unit(const Vec3& c) {
    const auto clamp = [](float v) { return v < 0 ? 0.0F : v > 1 ? 1.0F : v; };
    return {clamp(c.x), clamp(c.y), clamp(c.z)};
  }
  const DiffuseScene* scene_;
};

}  // namespace rnmbake
