// trace/light_bounds.h - where lamps and glowing triangles are and which way they shine, for the light tree.
#pragma once

#include "trace/light_glow.h"
#include "trace/light_lamp.h"
#include "trace/light_tree.h"

namespace rnmbake {

/// Of any lamp but a sun.
[[nodiscard]] LightBounds lamp_bounds(const Lamp& lamp);
[[nodiscard]] LightBounds glow_bounds(const Glow& glow);

}  // namespace rnmbake
