// pipeline/probes/picture_probe.h - a light probe out of pictures of the light around a point.
#pragma once

#include "encoding/ambient_cube.h"
#include "encoding/distant_light.h"
#include "pipeline/study/probe.h"
#include "probes/probe_volume.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// Six square pictures of radiance: the faces px, nx, py, ny, pz, nz of a cube map as OpenGL samples it,
/// whose y points up; turned so that Blender's z does. Throws as read_image(), and Error(invalid_input) where
/// faces are not square, differ in size, or hold values that are no numbers.
[[nodiscard]] DistantLight read_cube_map(const std::array<std::filesystem::path, 6>& faces);

/// One picture in latitudes and longitudes, or six faces. Throws Error(usage) for other numbers of files.
[[nodiscard]] DistantLight read_light(const std::vector<std::filesystem::path>& files);

/// Exact at each direction; harmonics summed over the sources.
[[nodiscard]] LightProbe probe_of(const DistantLight& light);

/// Ambient cubes of the same light, E/pi: as quick demos fill them, by the mean of each face; exact at the
/// axes; of least squares.
struct PictureCubes {
  AmbientCube faces, exact, fitted;
};
[[nodiscard]] PictureCubes cubes_of(const DistantLight& light);

/// The cubes side by side, and the errors of each encoding over the whole sphere.
[[nodiscard]] std::string picture_text(const PictureCubes& cubes, const ProbeTable& table);

}  // namespace rnmbake
