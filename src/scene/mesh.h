// scene/mesh.h - a mesh as Blender evaluated it, in the object's own space.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace rnmbake {

struct UvLayer {
  std::string name;
  std::vector<Vec2> uv;  // [loops]
};

/// Loops are face corners. Triangles are Blender's own ("loop triangles"), the ones that Cycles renders.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;                  // [vertices]
  std::vector<std::uint32_t> loop_vertex;       // [loops] -> vertices
  std::vector<Vec3> loop_normal;                // [loops], unit: smooth, split or custom normals
  std::vector<std::uint32_t> triangle_loops;    // [3 x triangles] -> loops
  std::vector<std::uint32_t> triangle_polygon;  // [triangles] -> polygons
  std::vector<std::uint32_t> polygon_start;     // [polygons] -> first loop
  std::vector<std::uint32_t> polygon_size;      // [polygons]
  std::vector<std::uint32_t> polygon_slot;      // [polygons] -> material slot
  std::vector<UvLayer> uv_layers;
  int active_uv = -1;  // index into uv_layers, -1: none
  int render_uv = -1;  // the layer that image textures use by default (active-render)

  [[nodiscard]] std::size_t triangles() const { return triangle_polygon.size(); }
  /// Their numbers: 0, 1, ...
  [[nodiscard]] std::vector<std::uint32_t> all_triangles() const {
    std::vector<std::uint32_t> numbers(triangles());
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
  }
  [[nodiscard]] std::uint32_t corner_vertex(std::size_t corner) const {
    return loop_vertex[triangle_loops[corner]];
  }
};

}  // namespace rnmbake
