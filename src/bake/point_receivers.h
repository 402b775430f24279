// bake/point_receivers.h - receivers in free space: a triangle of one texel for each point and direction.
//
// A small white triangle that faces along d holds E(d)/pi: the light of the hemisphere around d, by the
// cosine to d. No surface lies below it, so nothing keeps light from its back but that it has one, and no
// normal of its corners is off its face.
#pragma once

#include "bake/atlas.h"
#include "bake/receiver.h"

#include <array>
#include <cstddef>
#include <span>

namespace rnmbake {

/// Texels of a map with one for each point, about square. Point i is texel i % width of row i / width; rows
/// count from below. The last row may not be full.
[[nodiscard]] RectSize point_map(std::size_t points);

/// Distance from a point to the corners of its triangles along each of two axes, world units.
///
/// At least 2^steps_log2 float steps of the point's largest coordinate. With 256 of them rounded corners turn
/// the face (and with it the hemisphere, not the corner normals) by no more than 0.2 degrees: 0.03 mm at 1,
/// 3 cm at 1000, which is what Cycles itself may move the start of a ray by. Near the origin 1e-6, where the
/// square of an area is no denormal number yet.
[[nodiscard]] double point_receiver_size(const Vec3d& point, int steps_log2 = 8);

/// Three corners around `point`, `size` away along each axis across `direction`, which is their normal. Their
/// UVs stay inside the point's texel of `map`, whose centre maps to the point.
[[nodiscard]] std::array<ReceiverCorner, 3> point_receiver(const Vec3d& point, const Vec3& direction,
                                                           double size, std::size_t texel,
                                                           const RectSize& map);

/// One pass with role basis for each direction (unit, world space); its triangles are in the order of the
/// points, and the centre of a point's texel maps to the point.
[[nodiscard]] ReceiverPasses make_point_receivers(std::span<const Vec3d> points,
                                                  std::span<const Vec3> directions);

}  // namespace rnmbake
