// ssbump/heights/height_mesh.h - a height field as triangles, for tracers of meshes.
#pragma once

#include "base/math.h"
#include "ssbump/heights/height_field.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Vertices stand at texel centres, (column, -row, height), and on the bilinear surface between them: a patch
/// is cut into cells, and each of those is four triangles that meet in its middle.
struct HeightMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // anti-clockwise seen from above
};

/// Placement of a copy of the mesh: x is `sign_x` times x plus `shift_x`, and y alike.
struct HeightCopy {
  float shift_x = 0, shift_y = 0;
  int sign_x = 1, sign_y = 1;
};

/// Number of cells of a patch along each axis. Seen from a texel's centre, only the slope of the first cell
/// is not the bilinear surface's, so the finer cuts have narrow cells about the centres.
enum class PatchCuts { one, three, five };

/// One period of the field with the patches that join it to the next. Along an axis of WrapMode::none the
/// border's heights go on as far as useful_reach(). Where heights change by a texel from one to the next,
/// weights differ from the bilinear surface's by some 0.005 with one cell a patch, by less than 0.001 with
/// five.
[[nodiscard]] HeightMesh height_mesh(const HeightField& field, PatchCuts cuts = PatchCuts::five);

/// The copies of height_mesh() that lie within `reach` texels of the field, the field itself first.
[[nodiscard]] std::vector<HeightCopy> height_copies(const HeightField& field, double reach);

/// Distance, in texels, that copies have to cover: 64 times the range of heights, beyond which an unoccluded
/// ray is less than a degree above the horizon; at least one period, at most 16.
[[nodiscard]] double useful_reach(const HeightField& field);

}  // namespace rnmbake
