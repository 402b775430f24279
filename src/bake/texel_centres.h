// bake/texel_centres.h - leaves out triangles of receivers that hold no texel's centre.
//
// Blender bakes a texel by the last triangle that holds its centre, moved by up to 0.002 texels
// (scene/uv_raster.h), and samples never leave that triangle. So a triangle between the centres, of which
// meshes finer than their lightmap have hundreds of thousands, costs time and lights nothing. Lightmaps are
// the same bit for bit in 3.4 and 4.2; in 5.0 a texel in thousands may differ in its last binary digit.
#pragma once

#include "bake/atlas.h"
#include "bake/receiver.h"
#include "base/math.h"

#include <array>
#include <vector>

namespace rnmbake {

/// Texels from a texel's centre, along each axis, within which a triangle counts as holding it: far more than
/// Blender's offsets and what an atlas of 32-bit UVs rounds.
inline constexpr double centre_margin = 1.0 / 32;

/// Whether the centre of a texel of the map lies in the triangle, or so near that rounding may put it there.
/// `uv`: v up, [0,1] is the map.
[[nodiscard]] bool may_hold_centre(const std::array<Vec2, 3>& uv, const RectSize& map);

/// Removes the triangles (three corners each) that hold no centre; the others stay in order.
void drop_between_centres(std::vector<ReceiverCorner>& corners, const RectSize& map);

}  // namespace rnmbake
