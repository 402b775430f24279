// trace/scene.h - a scene to trace rays in.
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"
#include "trace/geometry/surface_materials.h"
#include "trace/geometry/triangles.h"
#include "trace/lights/lights.h"
#include "trace/ray_log.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

struct Ray {
  Vec3 origin, direction;  // unit direction
  float to = 0;            // distance of the end; may be infinity
};

struct Hit {
  std::uint32_t triangle = 0;  // index into Triangles
  float b1 = 0, b2 = 0;        // barycentric coordinates of corners 1 and 2
  float distance = 0;
  Vec3 normal;  // geometric, unit, world space: of the triangle's front
};

/// A hit on a see-through surface.
struct TransparentHit {
  Hit hit;
  Vec3 transmittance;
  float transmit_probability = 0;  // of a path going straight on, in (0, 1]
};

/// Transmission along a segment.
struct Visibility {
  Vec3 transmittance{1, 1, 1};
  float transmit_probability = 1;  // of a path passing all of it; 0: an opaque surface is between
  [[nodiscard]] bool blocked() const { return transmit_probability == 0; }
};

class Accelerator;

/// All positions, of rays and lights too, are relative to origin(), so that the precision of floats does not
/// depend on where a scene stands. Owns the acceleration structure; the DiffuseScene must outlive it.
/// Thread-safe once constructed.
class TraceScene {
 public:
  /// `blender_version`: whose light units hold (trace/lights/lights.h). Throws Error(environment) where
  /// Embree fails.
  TraceScene(const DiffuseScene& scene, const std::string& blender_version);
  ~TraceScene();
  TraceScene(const TraceScene&) = delete;
  TraceScene& operator=(const TraceScene&) = delete;

  /// The nearest opaque hit, and all see-through hits before it, from near to far (see trace/transparency.h).
  [[nodiscard]] bool intersect(const Ray& ray, Hit& hit, std::vector<TransparentHit>& transparent_hits) const;
  [[nodiscard]] Visibility visibility(const Ray& ray) const;
  /// Of at most `packet` coherent rays: one result for each.
  void visibility(std::span<const Ray> rays, Visibility* results) const;
  static constexpr std::size_t packet = 8;

  [[nodiscard]] const DiffuseScene& diffuse_scene() const { return diffuse_scene_; }
  /// In the exchange's world.
  [[nodiscard]] const Vec3d& origin() const { return origin_; }
  /// Places in the exchange's world as rays take them.
  [[nodiscard]] std::vector<Vec3> relative(std::span<const Vec3d> places) const;
  [[nodiscard]] const Triangles& triangles() const { return triangles_; }
  [[nodiscard]] const Lights& lights() const { return lights_; }
  [[nodiscard]] const SurfaceMaterials& materials() const { return materials_; }

  /// For benchmarks: logs rays from now on; null: no longer.
  void log_rays(RayLog* log) { log_ = log; }
  /// Rays per second of a bare loop of Embree queries over a log.
  [[nodiscard]] double time_bare(const RayLog& log, int threads) const;

  /// Bytes of geometry, acceleration structure included.
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct TransparencyQuery;
  const DiffuseScene& diffuse_scene_;
  Vec3d origin_;
  Triangles triangles_;
  SurfaceMaterials materials_;
  Lights lights_;
  std::unique_ptr<Accelerator> accelerator_;
  RayLog* log_ = nullptr;
};

/// Distance off the surface at which rays start: rounding errors of a point grow with the coordinates that it
/// is interpolated from.
[[nodiscard]] inline float ray_offset_at(const Vec3& p) {
  return 1e-6F * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// A hit with its shading frame; both normals point to the side that the ray came from.
struct Vertex {
  Vec3 position;
  Vec3 face, normal;     // geometric and smooth, unit
  Vec3 wo;               // towards the ray's origin, unit
  float ray_offset = 0;  // of rays that start there
  float b1 = 0, b2 = 0;  // barycentric coordinates of corners 1 and 2
  Vec2 uv;               // of the material's pictures
  std::uint32_t triangle = 0, material = 0;
  bool back = false;  // hit from behind

  /// Origin of rays, off the face on the side that was hit; lights are sampled from there too.
  [[nodiscard]] Vec3 start() const { return position + face * ray_offset; }
  /// ... and on the other side.
  [[nodiscard]] Vec3 start_below() const { return position - face * ray_offset; }
};

/// UV of the material's pictures.
[[nodiscard]] Vec2 picture_uv(const TraceScene& scene, const Hit& hit);

[[nodiscard]] Vertex vertex_at(const TraceScene& scene, const Ray& ray, const Hit& hit);

}  // namespace rnmbake
