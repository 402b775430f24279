// trace/scene.h - a scene that rays can be shot into.
#pragma once

#include "base/math.h"
#include "scene/exchange.h"
#include "trace/lights.h"
#include "trace/looks.h"
#include "trace/triangles.h"

#include <cstdint>
#include <memory>
#include <string>

namespace rnmbake {

struct Ray {
  Vec3 origin, direction;  // unit direction
  float from = 0, to = 0;  // distances; `to` may be infinity
};

struct Hit {
  std::uint32_t triangle = 0;  // index into Triangles
  float b1 = 0, b2 = 0;        // barycentric weights of corners 1 and 2
  float distance = 0;
  Vec3 normal;  // geometric, unit, world space: of the triangle's front
};

/// Owns the acceleration structure; the Exchange must outlive it. Thread-safe once made.
class TraceScene {
 public:
  TraceScene(const Exchange& scene, const std::string& blender_version);
  ~TraceScene();
  TraceScene(const TraceScene&) = delete;
  TraceScene& operator=(const TraceScene&) = delete;

  [[nodiscard]] bool intersect(const Ray& ray, Hit& hit) const;
  [[nodiscard]] bool occluded(const Ray& ray) const;

  [[nodiscard]] const Exchange& exchange() const { return exchange_; }
  [[nodiscard]] const Triangles& triangles() const { return triangles_; }
  [[nodiscard]] const Lights& lights() const { return lights_; }
  [[nodiscard]] const Looks& looks() const { return looks_; }

  /// Interpolated at a hit.
  [[nodiscard]] Vec3 point(const Hit& hit) const;
  [[nodiscard]] Vec3 shading_normal(const Hit& hit) const;  // unit
  [[nodiscard]] Vec2 uv(const Hit& hit) const;

 private:
  struct Accelerator;
  const Exchange& exchange_;
  Triangles triangles_;
  Looks looks_;
  Lights lights_;
  std::unique_ptr<Accelerator> accelerator_;
};

}  // namespace rnmbake
