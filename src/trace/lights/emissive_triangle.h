// trace/lights/emissive_triangle.h - the emissive triangles of a scene (mesh lights).
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"
#include "trace/geometry/triangles.h"
#include "trace/lights/light_triangle.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

struct EmissiveTriangle {
  LightTriangle shape;
  std::uint32_t triangle = 0;  // index into Triangles
  float brightness = 0;        // mean emitted radiance, about; > 0
};

/// All triangles that emit anywhere, be it by one texel of a picture. Those whose area is 0 in floats are
/// left out: no ray hits them.
[[nodiscard]] std::vector<EmissiveTriangle> find_emissive_triangles(const DiffuseScene& scene,
                                                                    const Triangles& triangles);

}  // namespace rnmbake
