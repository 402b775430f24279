#include "trace/lights/light_tree.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr float slack = 1e-3F;  // rounding of cosines must not make a bound too low
constexpr float horizon_share =
    0.3F;  // of the weight at the horizon, where tilted basis directions receive much

/// Selects without a branch.
inline float pick(bool first, float a, float b) {
  return first ? a : b;
}

/// cos(max(0, a - b)) from the angles' cosines and sines.
inline float cosine_between(float cos_a, float sin_a, float cos_b, float sin_b) {
  const float turned = cos_a * cos_b + sin_a * sin_b;
  return pick(cos_a > cos_b, 1.0F, turned);
}

inline float sine_of(float cosine) {
  const float rest = 1 - cosine * cosine;
  return std::sqrt(pick(rest > 0, rest, 0.0F));
}

}  // namespace

/// Returns the sum of the lanes' weights. A weight is an upper bound over the lane's sphere and cone: power x
/// cosine at the light x softened cosine at the surface / distance^2. Free of branches, so that compilers
/// vectorise it.
float LightTree::weigh(const Node& node, const Vec3& point, const Vec3& normal, Weights& weights) {
  Weights found;  // local, so that nothing aliases it
  const float horizon = normal == Vec3(0, 0, 0) ? 1.0F : horizon_share;
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const float wx = point.x - node.x[i], wy = point.y - node.y[i], wz = point.z - node.z[i];
    const float distance2 = wx * wx + wy * wy + wz * wz, radius2 = node.radius2[i];
    const bool inside = distance2 <= radius2;
    const float scale = 1 / std::sqrt(pick(distance2 > 1e-30F, distance2, 1e-30F));
    // Half angle of the cone of directions to the sphere.
    const float sin_b2 = pick(inside, 1.0F, radius2 * scale * scale), rest_b = 1 - sin_b2;
    const float sin_b = std::sqrt(sin_b2), cos_outside = std::sqrt(pick(rest_b > 0, rest_b, 0.0F));
    const float cos_b = pick(inside, -1.0F, cos_outside);

    const float wo = (node.axis_x[i] * wx + node.axis_y[i] * wy + node.axis_z[i] * wz) * scale;
    const float two_sided = node.two_sided[i], either = std::abs(wo);
    const float along = pick(two_sided > 0, either, wo);
    const float off_axis = cosine_between(along, sine_of(along), node.cos_normals[i], node.sin_normals[i]);
    const float leaving = cosine_between(off_axis, sine_of(off_axis), cos_b, sin_b);
    const float least = pick(leaving > slack, leaving, slack), edge = node.emission[i] - slack;
    const float sent = pick(inside, 1.0F, pick(leaving < edge, 0.0F, least));

    const float facing = -(normal.x * wx + normal.y * wy + normal.z * wz) * scale;
    const float nearest = cosine_between(facing, sine_of(facing), cos_b, sin_b);
    const float above = horizon + (1 - horizon) * pick(nearest > 0, nearest, 0.0F);
    const float received = pick(inside, 1.0F, pick(nearest < -slack, 0.0F, above));

    const float further = pick(distance2 > radius2, distance2, radius2);
    found[i] = node.power[i] * sent * received / pick(further > 1e-20F, further, 1e-20F);
  }
  weights = found;
  float sum = 0;
  for (std::uint32_t i = 0; i < lanes; ++i) sum += weights[i];
  return sum;
}

float LightTree::importance(const Vec3& point, const Vec3& normal) const {
  Weights weights;
  return empty() ? 0.0F : weigh(nodes_[0], point, normal, weights);
}

LightTree::Choice LightTree::choose(const Vec3& point, const Vec3& normal, float& u) const {
  if (empty()) return {};
  Weights weights;
  float probability = 1;
  for (std::uint32_t at = 0;;) {
    const float sum = weigh(nodes_[at], point, normal, weights);
    if (!(sum > 0)) return {};
    // The lane in which u x sum falls; the last with any weight, should rounding run past the end.
    float left = u * sum;
    std::uint32_t lane = 0, fallback = lanes;
    for (; lane < lanes; ++lane) {
      if (weights[lane] <= 0) continue;
      if (left < weights[lane]) break;
      left -= weights[lane];
      fallback = lane;
    }
    if (lane == lanes) {
      lane = fallback;
      left = weights[lane];
    }
    u = std::clamp(left / weights[lane], 0.0F, 0.99999994F);
    probability *= weights[lane] / sum;
    const std::uint32_t child = nodes_[at].child[lane];
    if ((child & light_bit) != 0) return {child & ~light_bit, probability};
    at = child;
  }
}

float LightTree::probability(const Vec3& point, const Vec3& normal, std::uint32_t light) const {
  Weights weights;
  float probability = 1;
  for (Slot slot = slots_[light];; slot = parents_[slot.node]) {
    const float sum = weigh(nodes_[slot.node], point, normal, weights);
    if (!(weights[slot.lane] > 0)) return 0;
    probability *= weights[slot.lane] / sum;
    if (slot.node == 0) return probability;
  }
}

}  // namespace rnmbake
