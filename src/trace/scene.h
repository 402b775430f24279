// trace/scene.h - a scene that rays can be shot into.
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
  float to = 0;            // distance; may be infinity
};

struct Hit {
  std::uint32_t triangle = 0;  // index into Triangles
  float b1 = 0, b2 = 0;        // barycentric weights of corners 1 and 2
  float distance = 0;
  Vec3 normal;  // geometric, unit, world space: of the triangle's front
};

/// A see-through surface on a ray's way.
struct TransparentHit {
  Hit hit;
  Vec3 transmittance;
  float transmit_probability = 0;  // share of the paths that go on through it, in (0, 1]
};

/// What gets from one place to another.
struct Visibility {
  Vec3 transmittance{1, 1, 1};     // share of the light
  float transmit_probability = 1;  // share of the paths that set out that way; 0: something opaque is between
  [[nodiscard]] bool blocked() const { return transmit_probability == 0; }
};

class Accelerator;

/// All places, of rays and lights too, are relative to origin(), so that how exact they are does not depend
/// on where a scene stands. Owns the acceleration structure; the DiffuseScene must outlive it. Thread-safe
/// once made.
class TraceScene {
 public:
  /// `blender_version`: whose light units hold (trace/lights/lights.h). Throws Error(environment) where
  /// Embree fails.
  TraceScene(const DiffuseScene& scene, const std::string& blender_version);
  ~TraceScene();
  TraceScene(const TraceScene&) = delete;
  TraceScene& operator=(const TraceScene&) = delete;

  /// The nearest opaque place, and all see-through ones before it, from near to far. trace/transparency.h
  /// follows them.
  [[nodiscard]] bool intersect(const Ray& ray, Hit& hit, std::vector<TransparentHit>& transparent_hits) const;
  [[nodiscard]] Visibility visibility(const Ray& ray) const;
  /// Of rays that start or end near each other, at most 8 at a time: one result for each.
  void visibility(std::span<const Ray> rays, Visibility* results) const;
  static constexpr std::size_t packet = 8;

  [[nodiscard]] const DiffuseScene& diffuse_scene() const { return diffuse_scene_; }
  /// In the exchange's world.
  [[nodiscard]] const Vec3d& origin() const { return origin_; }
  [[nodiscard]] const Triangles& triangles() const { return triangles_; }
  [[nodiscard]] const Lights& lights() const { return lights_; }
  [[nodiscard]] const SurfaceMaterials& materials() const { return materials_; }

  /// For benchmarks: where rays are noted from now on; null: nowhere.
  void log_rays(RayLog* log) { log_ = log; }
  /// Rays per second of a loop that does nothing but ask Embree about the rays of a log.
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

/// How far off a surface rays start: a point's rounding errors grow with the coordinates that it is mixed
/// from.
[[nodiscard]] inline float ray_offset_at(const Vec3& p) {
  return 1e-6F * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// Where a ray met a surface; both normals point to the side that it came from.
struct Vertex {
  Vec3 position;
  Vec3 face, normal;     // geometric and smooth, unit
  Vec3 wo;               // where it was met from, unit
  float ray_offset = 0;  // rays that leave start so far off the face
  float b1 = 0, b2 = 0;  // barycentric weights of corners 1 and 2
  Vec2 uv;               // of the look's pictures
  std::uint32_t triangle = 0, material = 0;
  bool back = false;  // met from behind

  /// Where rays start: off the face, on the side that it was met from. Lights are looked at from there too.
  [[nodiscard]] Vec3 start() const { return position + face * ray_offset; }
  /// ... and on the other side.
  [[nodiscard]] Vec3 start_below() const { return position - face * ray_offset; }
};

/// Of the look's pictures.
[[nodiscard]] Vec2 picture_uv(const TraceScene& scene, const Hit& hit);

[[nodiscard]] Vertex vertex_at(const TraceScene& scene, const Ray& ray, const Hit& hit);

}  // namespace rnmbake
