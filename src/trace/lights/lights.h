// trace/lights/lights.h - all lights of a scene, to be sampled from a point: lamps, suns, the world, emissive
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

/// `normal`: of the hemisphere that light is sampled for; the zero vector: of the whole sphere.
/// Lamps (point, spot, area, sun) are found by sample() alone. Rays hit emissive triangles and the world as
/// well, so these have a pdf for a given direction.
class Lights {
 public:
  /// Scene and triangles must outlive it. The triangles, and with them all points, are relative to `origin`.
  /// `blender_version` ("3.4.1"): whose units the lamps have (docs/reference.md).
  Lights(const DiffuseScene& scene, const Triangles& triangles, const std::string& blender_version,
         const Vec3d& origin = Vec3d(0));
  ~Lights();
  Lights(Lights&&) noexcept;
  Lights& operator=(Lights&&) noexcept;

  [[nodiscard]] bool empty() const;

  /// `u` in [0,1)^3: the choice of the light, and the point on it.
  [[nodiscard]] LightSample sample(const Vec3& point, const Vec3& normal, const Vec3& u) const;

  /// Radiance of the world from a direction.
  [[nodiscard]] Vec3 world(const Vec3& direction) const;
  /// Whether it is the same from every direction: Cycles then does not sample it as a light.
  [[nodiscard]] bool world_is_even() const;
  /// Pdf of sample() for the world in a direction.
  [[nodiscard]] float world_pdf(const Vec3& point, const Vec3& normal, const Vec3& direction) const;
  /// ... and for a point on an emissive triangle (index into Triangles) at `distance` along `direction`.
  [[nodiscard]] float triangle_pdf(const Vec3& point, const Vec3& normal, std::uint32_t triangle,
                                   const Vec3& direction, float distance) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rnmbake
