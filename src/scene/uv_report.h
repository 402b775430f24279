// scene/uv_report.h - what is right and wrong with a UV layer as a lightmap of a given size.
#pragma once

#include "base/math.h"
#include "scene/mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Texels per world unit along an edge: sqrt(texel area / world area) of a triangle.
struct TexelDensity {
  double min = 0, median = 0, max = 0;  // the median is that of the surface, not of the triangles
};

struct UvReport {
  std::size_t triangles = 0;
  double uv_area = 0;     // of the unit square; folds and overlaps count twice
  double world_area = 0;  // square units
  TexelDensity density;   // over triangles that have area in both

  std::size_t covered_texels = 0;   // texels whose centre lies in a triangle
  std::size_t overlap_texels = 0;   // ... in more than one
  std::size_t outside_corners = 0;  // triangle corners outside [0,1] x [0,1]
  double outside_texels = 0;        // texel areas outside it
  std::size_t tile_triangles = 0;   // triangles in another whole square of the UV plane: UDIM tiles

  std::size_t charts = 0;            // patches that hang together in UV
  std::size_t mirrored_charts = 0;   // their UVs wind against the faces
  std::size_t degenerate_uv = 0;     // triangles that have area in the world and none in UV
  std::size_t degenerate_world = 0;  // triangles without area in the world
  std::size_t doubled = 0;           // triangles on an earlier one: the same corners, seen from the same side
  bool all_zero = false;             // every corner at one and the same place: not unwrapped

  /// Nothing in the way of a lightmap without bleeding or loss.
  [[nodiscard]] bool clean() const {
    return !all_zero && overlap_texels == 0 && outside_corners == 0 && degenerate_uv == 0;
  }
};

/// `uv` has one entry for each loop of the mesh; width and height are the lightmap's.
[[nodiscard]] UvReport report_uv(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                                 const std::vector<Vec2>& uv, const Mat44& to_world, int width, int height);
/// Of the whole mesh.
[[nodiscard]] UvReport report_uv(const Mesh& mesh, const std::vector<Vec2>& uv, const Mat44& to_world,
                                 int width, int height);

}  // namespace rnmbake
