// trace/lights/lights.h - everything that emits, to be sampled from a point: lamps, suns, world, glowing
// triangles.
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"
#include "trace/geometry/triangles.h"
#include "trace/lights/light_sample.h"

#include <cstdint>
#include <memory>
#include <string>

namespace rnmbake {

/// `normal`: only light from its side counts; the zero vector: light from everywhere.
/// Lamps (point, spot, area, sun) are met by sample() alone. Glowing triangles and the world are met by rays
/// too, so they have a pdf for a given direction.
class Lights {
 public:
  /// Scene and triangles must outlive it; the triangles are relative to `origin`, and so is everything then.
  /// `blender_version` ("3.4.1") says what the numbers of a light mean (docs/reference.md).
  Lights(const DiffuseScene& scene, const Triangles& triangles, const std::string& blender_version,
         const Vec3d& origin = Vec3d(0));
  ~Lights();
  Lights(Lights&&) noexcept;
  Lights& operator=(Lights&&) noexcept;

  [[nodiscard]] bool empty() const;

  /// `u` in [0,1)^3: the choice, and the place on the light.
  [[nodiscard]] LightSample sample(const Vec3& point, const Vec3& normal, const Vec3& u) const;

  /// Radiance from a direction in which nothing is hit.
  [[nodiscard]] Vec3 world(const Vec3& direction) const;
  /// The same in every direction: sampled here, but left to chance by Cycles.
  [[nodiscard]] bool world_is_even() const;
  /// What sample() would have as pdf for that direction of the world.
  [[nodiscard]] float world_pdf(const Vec3& point, const Vec3& normal, const Vec3& direction) const;
  /// ... and for a place on a glowing triangle (index into Triangles) at `distance` along `direction`.
  [[nodiscard]] float triangle_pdf(const Vec3& point, const Vec3& normal, std::uint32_t triangle,
                                   const Vec3& direction, float distance) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rnmbake
