// bake/clip.h - cuts triangles by linear functions of their corners.
#pragma once

#include "base/math.h"

#include <array>
#include <cstddef>
#include <vector>

namespace rnmbake {

/// A corner of a cut triangle as weights of the three original corners.
using Weights = Vec3;
using WeightPolygon = std::vector<Weights>;

[[nodiscard]] inline WeightPolygon whole_triangle() {
  return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

/// The part of `polygon` where the linear function with these corner values is >= 0.
[[nodiscard]] WeightPolygon clip(const WeightPolygon& polygon, const std::array<float, 3>& corner_values);

/// The polygon as triangles (three weights each), every one divided into parts x parts smaller ones.
[[nodiscard]] std::vector<Weights> triangulate(const WeightPolygon& polygon, int parts = 1);

}  // namespace rnmbake
