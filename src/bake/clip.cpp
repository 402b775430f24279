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
    if ((value >= 0) != (value_next >= 0)) kept.push_back(here + (next - here) * (value / (value - value_next)));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace rnmbake
