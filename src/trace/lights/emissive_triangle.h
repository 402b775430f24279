// trace/lights/emissive_triangle.h - the triangles of a scene that glow, and how strongly.
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
  float brightness = 0;        // of its emission, on average; > 0
};

/// Every triangle that shines anywhere, be it by one texel of a picture. One whose area is lost in floats is
/// left out: rays never meet it.
[[nodiscard]] std::vector<EmissiveTriangle> glowing_triangles(const DiffuseScene& scene,
                                                              const Triangles& triangles);

}  // namespace rnmbake
