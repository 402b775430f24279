#include "bake/clip.h"

namespace rnmbake {
namespace {

float value_at(const Weights& w, const std::array<float, 3>& values) {
  return w.x * values[0] + w.y * values[1] + w.z * values[2];
}

}  // namespace

WeightPolygon clip(const WeightPolygon& polygon, const std::array<float, 3>& corner_values) {
  WeightPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Weights& here = polygon[i];
    const Weights& next = polygon[(i + 1) % polygon.size()];
    const float value = value_at(here, corner_values), value_next = value_at(next, corner_values);
    if (value >= 0) kept.push_back(here);
    // A corner on the line itself is kept above, not cut again.
    if (value * value_next < 0) kept.push_back(here + (next - here) * (value / (value - value_next)));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

std::vector<Weights> triangulate(const WeightPolygon& polygon, int parts) {
  std::vector<Weights> triangles;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Weights& origin = polygon[0];
    const Weights step1 = (polygon[i - 1] - origin) / static_cast<float>(parts);
    const Weights step2 = (polygon[i] - origin) / static_cast<float>(parts);
    const auto at = [&](int a, int b) {
      return origin + step1 * static_cast<float>(a) + step2 * static_cast<float>(b);
    };
    for (int a = 0; a < parts; ++a) {
      for (int b = 0; a + b < parts; ++b) {
        triangles.insert(triangles.end(), {at(a, b), at(a + 1, b), at(a, b + 1)});
        if (a + b + 1 < parts)
          triangles.insert(triangles.end(), {at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)});
      }
    }
  }
  return triangles;
}

}  // namespace rnmbake
