// trace/geometry/surface_materials.h - albedo, emission and transmittance at a place on a triangle.
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"

#include <cstdint>

namespace rnmbake {

/// Bilinear, clamped at the borders, v up: what Cycles' image texture gives with Linear and EXTEND.
[[nodiscard]] Vec3 look_up(const Picture& picture, const Vec2& uv);

class Looks {
 public:
  explicit Looks(const Exchange& scene) : scene_(&scene) {}

  /// In [0, 1].
  [[nodiscard]] Vec3 albedo(std::uint32_t look, const Vec2& uv) const {
    const Look& it = scene_->looks[look];
    return it.albedo_picture < 0 ? it.albedo : unit(look_up(scene_->pictures[it.albedo_picture], uv));
  }
  /// In [0, 1].
  [[nodiscard]] Vec3 transmittance(std::uint32_t look, const Vec2& uv) const {
    const Look& it = scene_->looks[look];
    if (it.transmittance_picture < 0) return it.transmittance;
    return unit(look_up(scene_->pictures[it.transmittance_picture], uv));
  }
  /// Whether light goes through some of it.
  [[nodiscard]] bool see_through(std::uint32_t look) const { return scene_->looks[look].see_through(); }
  /// Radiance.
  [[nodiscard]] Vec3 emission(std::uint32_t look, const Vec2& uv) const {
    const Look& it = scene_->looks[look];
    return it.emission_picture < 0 ? it.emission : look_up(scene_->pictures[it.emission_picture], uv);
  }
  [[nodiscard]] bool emits(std::uint32_t look) const {
    const Look& it = scene_->looks[look];
    return it.emission_picture >= 0 || it.emission != Vec3(0, 0, 0);
  }

 private:
  [[nodiscard]] static Vec3 unit(const Vec3& c) {
    const auto clamp = [](float v) { return v < 0 ? 0.0F : v > 1 ? 1.0F : v; };
    return {clamp(c.x), clamp(c.y), clamp(c.z)};
  }
  const Exchange* scene_;
};

}  // namespace rnmbake
