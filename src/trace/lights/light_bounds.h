// trace/lights/light_bounds.h - where lamps and glowing triangles are and which way they shine, for the light
// tree.
#pragma once

#include "trace/lights/emissive_triangle.h"
#include "trace/lights/lamp.h"
#include "trace/lights/light_tree.h"

namespace rnmbake {

/// Of any lamp but a sun.
[[nodiscard]] LightBounds lamp_bounds(const Lamp& lamp);
[[nodiscard]] LightBounds emissive_triangle_bounds(const EmissiveTriangle& glow);

}  // namespace rnmbake
