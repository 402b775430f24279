// scene/tangent_groups.h - which triangle corners share one MikkTSpace tangent.
#pragma once

#include <cstdint>
#include <vector>

namespace rnmbake {

inline constexpr std::uint32_t no_group = ~std::uint32_t{0};

/// What the grouping must know of a triangle.
struct TriangleUv {
  bool flat = false;       // two corners in one place: takes no part, and copies a neighbour's tangent
  bool any = false;        // no usable UV gradient: goes with the first group that reaches it
  bool preserving = true;  // UVs wind as the positions do; false: mirrored
};

/// The group of every corner, no_group where there is none. `corner_vertex` numbers the corners so that equal
/// position, normal and UV have equal numbers. A group grows over edges that two triangles share, one winding
/// each, around one vertex and within one orientation. `triangles[i].preserving` of an `any` triangle becomes
/// that of its group.
[[nodiscard]] std::vector<std::uint32_t> tangent_groups(const std::vector<std::uint32_t>& corner_vertex,
                                                        std::vector<TriangleUv>& triangles);

}  // namespace rnmbake
