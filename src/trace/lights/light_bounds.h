// trace/lights/light_bounds.h - bounds of lamps and emissive triangles for the light tree.
#pragma once

#include "trace/lights/emissive_triangle.h"
#include "trace/lights/lamp.h"
#include "trace/lights/light_tree.h"

namespace rnmbake {

/// Of any lamp but a sun.
[[nodiscard]] LightBounds lamp_bounds(const Lamp& lamp);
[[nodiscard]] LightBounds emissive_triangle_bounds(const EmissiveTriangle& emitter);

}  // namespace rnmbake
