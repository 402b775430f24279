#include "trace/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {
namespace {

constexpr std::size_t most_in_leaf = LightTree::few_lights;
constexpr float slack = 1e-3F;         // cosines may be off by rounding: rather too much than nothing
constexpr float horizon_share = 0.3F;  // of a light at the horizon; see light_importance()

/// cos(max(0, a - b)) from the angles' cosines and sines.
float cosine_between(float cos_a, float sin_a, float cos_b, float sin_b) {
  return cos_a > cos_b ? 1.0F : cos_a * cos_b + sin_a * sin_b;
}

float sine_of(float cosine) {
  return std::sqrt(std::max(1 - cosine * cosine, 0.0F));
}

/// Keeps `u` even after it chose [from, to).
void reuse(float& u, float from, float to) {
  u = std::clamp((u - from) / (to - from), 0.0F, 0.99999994F);
}

}  // namespace

float light_importance(const LightBounds& bounds, const Vec3& point, const Vec3& normal) {
  const Vec3 way = point - (bounds.low + bounds.high) * 0.5F;
  const float radius2 = (bounds.high - bounds.low).length2() / 4, distance2 = way.length2();
  const float near2 = std::max({distance2, radius2, 1e-20F});
  // The directions from the point to the bounds lie in this cone.
  const bool inside = distance2 <= radius2;
  const Vec3 out = inside ? Vec3(0, 0, 0) : way / std::sqrt(distance2);
  const float sin_b2 = inside ? 1.0F : radius2 / distance2;
  const float sin_b = std::sqrt(sin_b2), cos_b = inside ? -1.0F : std::sqrt(1 - sin_b2);

  float leaving = 1;
  if (!inside) {
    float along = bounds.axis.dot(out);
    if (bounds.two_sided) along = std::abs(along);
    const float sin_n = sine_of(bounds.normals), sin_along = sine_of(along);
    const float off_axis = cosine_between(along, sin_along, bounds.normals, sin_n);
    leaving = cosine_between(off_axis, sine_of(off_axis), cos_b, sin_b);
    if (leaving < bounds.emission - slack) return 0;
    leaving = std::max(leaving, slack);
  }
  float arriving = 1;
  if (!inside && normal != Vec3(0, 0, 0)) {
    const float along = -normal.dot(out);
    const float nearest = cosine_between(along, sine_of(along), cos_b, sin_b);
    if (nearest < -slack) return 0;
    arriving = horizon_share + (1 - horizon_share) * std::max(nearest, 0.0F);
  }
  return bounds.power * leaving * arriving / near2;
}

float LightTree::importance(const Vec3& point, const Vec3& normal) const {
  if (empty()) return 0;
  const Node& root = nodes_[0];
  if (root.count == 0) {
    return light_importance(nodes_[1].bounds, point, normal) +
           light_importance(nodes_[root.first].bounds, point, normal);
  }
  float sum = 0;
  for (std::uint32_t i = 0; i < root.count; ++i) sum += light_importance(lights_[i], point, normal);
  return sum;
}

LightTree::Choice LightTree::choose(const Vec3& point, const Vec3& normal, float& u) const {
  if (empty()) return {};
  float probability = 1;
  std::uint32_t at = 0;
  while (nodes_[at].count == 0) {
    const float first = light_importance(nodes_[at + 1].bounds, point, normal);
    const float second = light_importance(nodes_[nodes_[at].first].bounds, point, normal);
    if (!(first + second > 0)) return {};
    const float share = first / (first + second);
    const bool second_one = u >= share;
    if (second_one)
      reuse(u, share, 1);
    else
      reuse(u, 0, share);
    probability *= second_one ? 1 - share : share;
    at = second_one ? nodes_[at].first : at + 1;
  }
  const Node& leaf = nodes_[at];
  std::array<float, most_in_leaf> weights{};
  float sum = 0;
  std::uint32_t chosen = 0;
  for (std::uint32_t i = 0; i < leaf.count; ++i) {
    weights[i] = light_importance(lights_[leaf.first + i], point, normal);
    sum += weights[i];
    if (weights[i] > 0) chosen = i;  // the last one that can be, should rounding run past the end
  }
  if (!(sum > 0)) return {};
  float below = 0;
  for (std::uint32_t i = 0; i <= chosen; ++i) {
    const float above = below + weights[i] / sum;
    if (u < above || i == chosen) {
      reuse(u, below, above);
      return {indices_[leaf.first + i], probability * (weights[i] / sum)};
    }
    below = above;
  }
  return {};
}

float LightTree::probability(const Vec3& point, const Vec3& normal, std::uint32_t light) const {
  const Place& place = places_[light];
  std::uint64_t trail = place.trail;
  float probability = 1;
  std::uint32_t at = 0;
  for (; nodes_[at].count == 0; trail >>= 1) {
    const float first = light_importance(nodes_[at + 1].bounds, point, normal);
    const float second = light_importance(nodes_[nodes_[at].first].bounds, point, normal);
    if (!(first + second > 0)) return 0;
    const float share = first / (first + second);
    const bool second_one = (trail & 1) != 0;
    probability *= second_one ? 1 - share : share;
    at = second_one ? nodes_[at].first : at + 1;
  }
  const Node& leaf = nodes_[at];
  float sum = 0, own = 0;
  for (std::uint32_t i = 0; i < leaf.count; ++i) {
    const float weight = light_importance(lights_[leaf.first + i], point, normal);
    sum += weight;
    if (leaf.first + i == place.slot) own = weight;
  }
  return sum > 0 ? probability * (own / sum) : 0.0F;
}

}  // namespace rnmbake
