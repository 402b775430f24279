// Splits lights where the sum of power x area x solid angle of the two halves is least, by bins.
#include "trace/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace rnmbake {
namespace {

constexpr std::uint32_t leaf_lights = 4;  // as dear as the two levels they save
constexpr int bins = 12;
constexpr int deepest_guided = 30;  // below, halves of the same count: 2^34 more lights fit into a trail

/// The cone of normals around two cones.
void join_cones(LightBounds& a, const LightBounds& b) {
  a.two_sided = a.two_sided || b.two_sided;
  if (a.normals <= -1 || b.normals <= -1) {
    a.normals = -1;
    return;
  }
  // A two-sided light may as well be held the other way round.
  Vec3 other = b.axis;
  if (b.two_sided && a.axis.dot(other) < 0) other = -other;
  const float wide_a = std::acos(std::clamp(a.normals, -1.0F, 1.0F));
  const float wide_b = std::acos(std::clamp(b.normals, -1.0F, 1.0F));
  const float between = std::acos(std::clamp(a.axis.dot(other), -1.0F, 1.0F));
  const auto half_turn = static_cast<float>(pi);
  if (std::min(between + wide_b, half_turn) <= wide_a) return;
  if (std::min(between + wide_a, half_turn) <= wide_b) {
    a.axis = other;
    a.normals = b.normals;
    return;
  }
  const float wide = (wide_a + between + wide_b) / 2 + 1e-3F;  // acos rounds
  const Vec3 across = other - a.axis * a.axis.dot(other);
  const float length = across.length();
  if (wide >= half_turn || !(length > 1e-6F)) {
    a.normals = wide < half_turn && a.axis.dot(other) > 0 ? std::cos(wide) : -1.0F;
    return;
  }
  const float turn = wide - wide_a;
  a.axis = (a.axis * std::cos(turn) + across / length * std::sin(turn)).normalized();
  a.normals = std::cos(wide);
}

void join(LightBounds& a, const LightBounds& b) {
  for (int k = 0; k < 3; ++k) {
    a.low[k] = std::min(a.low[k], b.low[k]);
    a.high[k] = std::max(a.high[k], b.high[k]);
  }
  join_cones(a, b);
  a.emission = std::min(a.emission, b.emission);
  a.power += b.power;
}

/// Solid angle that a group lights, weighted by the cosine past its normals.
double lit_angle(const LightBounds& bounds) {
  const double normals = std::acos(std::clamp(double(bounds.normals), -1.0, 1.0));
  const double emission = std::acos(std::clamp(double(bounds.emission), -1.0, 1.0));
  const double edge = std::min(normals + emission, pi);
  const double cos_n = std::cos(normals), sin_n = std::sin(normals);
  return 2 * pi * (1 - cos_n) +
         pi / 2 * (2 * edge * sin_n - std::cos(normals - 2 * edge) - 2 * normals * sin_n + cos_n);
}

double cost(const LightBounds& bounds, const Vec3& whole, int axis) {
  const Vec3d size(bounds.high - bounds.low);
  const double surface = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  const double longest = std::max({whole.x, whole.y, whole.z});
  // Lights in a line or plane have no surface: a little of their extent keeps them apart.
  const double extent = surface + 1e-3 * size.length2();
  return bounds.power * lit_angle(bounds) * extent * (longest / std::max(double(whole[axis]), 1e-30));
}

}  // namespace

class LightTreeBuilder {
 public:
  LightTreeBuilder(LightTree& tree, const std::vector<LightBounds>& lights) : tree_(tree), lights_(lights) {
    order_.resize(lights.size());
    std::iota(order_.begin(), order_.end(), 0U);
    tree_.places_.resize(lights.size());
    tree_.nodes_.reserve(lights.size());
    build(0, static_cast<std::uint32_t>(lights.size()), 0, 0);
    for (std::uint32_t slot = 0; slot < order_.size(); ++slot) {
      tree_.lights_.push_back(lights[order_[slot]]);
      tree_.places_[order_[slot]].slot = slot;
    }
    tree_.indices_ = std::move(order_);
  }

 private:
  struct Bin {
    LightBounds bounds;
    std::uint32_t count = 0;
    void add(const LightBounds& other, std::uint32_t lights) {
      if (lights == 0) return;
      if (count == 0)
        bounds = other;
      else
        join(bounds, other);
      count += lights;
    }
  };

  static Vec3 centre(const LightBounds& bounds) { return (bounds.low + bounds.high) * 0.5F; }

  std::uint32_t build(std::uint32_t first, std::uint32_t last, std::uint64_t trail, int depth) {
    const auto at = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    LightBounds bounds = lights_[order_[first]];
    for (std::uint32_t i = first + 1; i < last; ++i) join(bounds, lights_[order_[i]]);
    tree_.nodes_[at].bounds = bounds;
    const std::uint32_t count = last - first;
    if (count <= (depth == 0 ? LightTree::few_lights : leaf_lights)) {
      tree_.nodes_[at].first = first;
      tree_.nodes_[at].count = count;
      for (std::uint32_t i = first; i < last; ++i) tree_.places_[order_[i]].trail = trail;
      return at;
    }
    const std::uint32_t middle = split(first, last, depth);
    build(first, middle, trail, depth + 1);
    const std::uint32_t second = build(middle, last, trail | (std::uint64_t(1) << depth), depth + 1);
    tree_.nodes_[at].first = second;
    return at;
  }

  std::uint32_t split(std::uint32_t first, std::uint32_t last, int depth) {
    Vec3 low = centre(lights_[order_[first]]), high = low;
    for (std::uint32_t i = first; i < last; ++i) {
      const Vec3 c = centre(lights_[order_[i]]);
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], c[k]);
        high[k] = std::max(high[k], c[k]);
      }
    }
    double best = std::numeric_limits<double>::infinity();
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3 && depth < deepest_guided; ++axis) {
      if (!(high[axis] > low[axis])) continue;
      consider(first, last, low, high, axis, best, best_axis, best_bin);
    }
    const auto begin = order_.begin();
    if (best_axis >= 0) {
      const auto middle = std::partition(begin + first, begin + last, [&](std::uint32_t i) {
        return bin_of(centre(lights_[i])[best_axis], low[best_axis], high[best_axis]) <= best_bin;
      });
      const auto index = static_cast<std::uint32_t>(middle - begin);
      if (index > first && index < last) return index;
    }
    return first + (last - first) / 2;
  }

  static int bin_of(float place, float low, float high) {
    return std::clamp(static_cast<int>(bins * ((place - low) / (high - low))), 0, bins - 1);
  }

  void consider(std::uint32_t first, std::uint32_t last, const Vec3& low, const Vec3& high, int axis,
                double& best, int& best_axis, int& best_bin) {
    std::array<Bin, bins> filled{};
    for (std::uint32_t i = first; i < last; ++i) {
      const LightBounds& light = lights_[order_[i]];
      filled[bin_of(centre(light)[axis], low[axis], high[axis])].add(light, 1);
    }
    std::array<double, bins> after{};  // cost of all bins past each
    Bin right;
    for (int b = bins - 1; b > 0; --b) {
      right.add(filled[b].bounds, filled[b].count);
      after[b - 1] = right.count > 0 ? cost(right.bounds, high - low, axis) : 0.0;
    }
    Bin left;
    for (int b = 0; b + 1 < bins; ++b) {
      left.add(filled[b].bounds, filled[b].count);
      if (left.count == 0 || left.count == last - first) continue;
      const double total = cost(left.bounds, high - low, axis) + after[b];
      if (total < best) {
        best = total;
        best_axis = axis;
        best_bin = b;
      }
    }
  }

  LightTree& tree_;
  const std::vector<LightBounds>& lights_;
  std::vector<std::uint32_t> order_;
};

LightTree::LightTree(const std::vector<LightBounds>& lights) {
  if (!lights.empty()) LightTreeBuilder(*this, lights);
}

}  // namespace rnmbake
