// ssbump/height_mesh.h - a height field as triangles, for whoever traces meshes.
#pragma once

#include "base/math.h"
#include "ssbump/height_field.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Vertices stand at texel centres, (column, -row, height), and in the middle of every patch, where the
/// bilinear surface is the mean of its corners: four triangles a patch.
struct HeightMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // anti-clockwise seen from above
};

/// Where a copy of the mesh lies: x is `sign_x` times x plus `shift_x`, and y alike.
struct HeightCopy {
  float shift_x = 0, shift_y = 0;
  int sign_x = 1, sign_y = 1;
};

/// One period of the field with the patches that join it to the next. Along an axis that nothing lies beyond
/// the border's heights go on for a thousand periods.
[[nodiscard]] HeightMesh height_mesh(const HeightField& field);

/// The copies of height_mesh() that lie within `reach` texels of the field, the field itself first.
[[nodiscard]] std::vector<HeightCopy> height_copies(const HeightField& field, double reach);

/// How far copies have to go: 64 times the range of heights, where a ray that has met nothing yet is less
/// than a degree above the horizon; at least one period, at most 16.
[[nodiscard]] double useful_reach(const HeightField& field);

}  // namespace rnmbake
