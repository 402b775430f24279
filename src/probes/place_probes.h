// probes/place_probes.h - where light probes stand: boxes, and lists of points.
#pragma once

#include "probes/probe_volume.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// A box along the world's axes.
struct ProbeBounds {
  Vec3d low{0, 0, 0}, high{0, 0, 0};
};

/// "x0,y0,z0,x1,y1,z1", the corners in any order. Throws Error(usage).
[[nodiscard]] ProbeBounds parse_bounds(const std::string& text);

/// Probes in the middles of equal cells that fill the box, about `spacing` apart along each axis: at least
/// one along each. Without a spacing about so many probes. With `levels`, for a tree whose cells are halved
/// so often at most: its smallest cells would fill the box like that, so that the grid's own probes reach
/// nearer to its sides; two along each axis at least where it is not flat. Throws Error(invalid_input) where
/// there would be more than most_probes, or the box is flat in two directions.
[[nodiscard]] ProbeGrid grid_in(const ProbeBounds& bounds, std::optional<double> spacing,
                                double probes = 1000, int levels = 0);

/// The cells' middles of the cube [-1, 1]^3 as `to_world` places it: Blender's light probe volumes.
[[nodiscard]] ProbeGrid grid_in_cube(const Mat44& to_world, const std::array<int, 3>& counts);

/// Three numbers in each line, separated by commas, semicolons or blanks; empty lines and those that begin
/// with # are skipped, as is a first line without numbers. Throws Error(io), and Error(invalid_input) naming
/// file and line.
[[nodiscard]] std::vector<Vec3d> read_points(const std::filesystem::path& file);

/// A volume whose probes stand at their places, without light yet.
[[nodiscard]] ProbeVolume empty_volume(std::string name, const ProbeGrid& grid);
[[nodiscard]] ProbeVolume empty_volume(std::string name, const std::vector<Vec3d>& points);

}  // namespace rnmbake
