// pipeline/deliver/engine_axes.h - packed layers from Blender's world axes to an engine's.
#pragma once

#include "image/float_image.h"

#include <array>

namespace rnmbake {

/// Which of Blender's axes one of the engine's is, and whether it points the other way.
struct EngineAxis {
  int blender = 0;
  bool reversed = false;
};

/// The engine's x, y and z.
using EngineAxes = std::array<EngineAxis, 3>;

/// glTF and Godot: (x, z, -y).
constexpr EngineAxes y_up_axes{{{0}, {2}, {1, true}}};

/// Left-handed, as importers of glTF and FBX turn it: (-x, z, -y).
constexpr EngineAxes unity_axes{{{0, true}, {2}, {1, true}}};

/// t of the axis the other way: t = 1/2 + v / (2 K a). What was fitted to the range in Blender's axes is the
/// fit in the engine's, too: its box |v_i| <= K a goes over into itself when axes change places or sign.
[[nodiscard]] inline FloatImage reversed_t(FloatImage t) {
  for (float& value : t.data()) value = 1 - value;
  return t;
}

}  // namespace rnmbake
