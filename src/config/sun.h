// config/sun.h - the sun of --sun, out of the words of a user.
#pragma once

#include <optional>
#include <string>

namespace rnmbake {

struct Sun {
  double azimuth = 0;    // degrees from +Y (north) over +X (east)
  double elevation = 0;  // degrees above the horizon, -90 to 90
  double strength = 0;   // W/m2 on a surface that faces it, as Blender counts: E/pi = strength / pi
};

/// Of "AZIMUTH,ELEVATION,STRENGTH"; nothing where the text is no such sun.
[[nodiscard]] std::optional<Sun> sun_of(const std::string& text);

}  // namespace rnmbake
