// probes/formats/engine_box.h - a box of probes along an engine's axes, its light turned with it.
#pragma once

#include "probes/probe_volume.h"

#include <array>
#include <string_view>

namespace rnmbake {

/// Which of Blender's axes, and which way, an engine's x, y and z are: rows of a matrix of 0 and +-1.
using EngineAxes = std::array<Vec3, 3>;

/// glTF, three.js, Godot, Bevy: right-handed, Y up; x, z, -y of Blender.
[[nodiscard]] const EngineAxes& y_up_axes();
/// Unity as glTF and FBX are imported there: left-handed, Y up; -x, z, -y of Blender.
[[nodiscard]] const EngineAxes& unity_axes();

[[nodiscard]] Vec3d to_engine(const EngineAxes& axes, const Vec3d& blender);
[[nodiscard]] Vec3 to_engine(const EngineAxes& axes, const Vec3& blender);
/// The inverse, which is the transpose.
[[nodiscard]] Vec3 from_engine(const EngineAxes& axes, const Vec3& engine);

/// Coefficients of radiance (encoding/sh.h) of the same light for directions along the engine's axes.
[[nodiscard]] std::array<Vec3, 9> turned(const EngineAxes& axes, const std::array<Vec3, 9>& harmonics);

/// E/pi at the engine's +x, -x, +y, -y, +z, -z.
[[nodiscard]] std::array<Vec3, 6> turned_cube(const EngineAxes& axes, const LightProbe& probe);

/// The probes of a grid, counted along axes that are as close to the engine's as they can be and of the same
/// handedness. Engine's world space.
struct EngineBox {
  std::array<int, 3> counts;
  Vec3d first;
  std::array<Vec3d, 3> steps;
  std::array<std::size_t, 3> strides;  // of ProbeVolume::probes, may wrap around as steps backwards
  std::size_t origin;                  // the first probe's place in ProbeVolume::probes

  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return origin + strides[0] * static_cast<std::size_t>(x) + strides[1] * static_cast<std::size_t>(y) +
           strides[2] * static_cast<std::size_t>(z);
  }
  /// The middle of the box in which every probe stands in the centre of a cell of its own.
  [[nodiscard]] Vec3d centre() const;
  /// Sizes of that box along the steps.
  [[nodiscard]] Vec3d size() const;
  /// The steps' directions as a unit quaternion x, y, z, w; of a right-angled box.
  [[nodiscard]] std::array<double, 4> rotation() const;
  [[nodiscard]] bool right_angled() const;
  /// Steps along the engine's own axes, forwards.
  [[nodiscard]] bool along_axes() const;
};

/// Throws Error(unsupported) that names the volume and `format` where it is points alone.
[[nodiscard]] EngineBox engine_box(const ProbeVolume& volume, const EngineAxes& axes,
                                   std::string_view format);

/// The same; throws as well where the steps are not at right angles, as engines place a box by a turn and
/// sizes.
[[nodiscard]] EngineBox right_angled_box(const ProbeVolume& volume, const EngineAxes& axes,
                                         std::string_view format);

}  // namespace rnmbake
