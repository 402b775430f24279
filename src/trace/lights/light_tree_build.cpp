// Builds the light tree: splits groups by the surface area orientation heuristic over bins.
#include "trace/lights/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

constexpr int bins = 12;
constexpr int deepest_guided = 40;              // below, the median
constexpr std::uint32_t most_with_cones = 256;  // larger groups emit everywhere, and joining cones is slow

/// The cone of normals around two cones.
void join_cones(LightBounds& a, const LightBounds& b) {
  a.two_sided = a.two_sided || b.two_sided;
  if (a.normals <= -1 || b.normals <= -1) {
    a.normals = -1;
    return;
  }
  // The axis of a two-sided light has no sign.
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

void join(LightBounds& a, const LightBounds& b, bool with_cones) {
  for (int k = 0; k < 3; ++k) {
    a.low[k] = std::min(a.low[k], b.low[k]);
    a.high[k] = std::max(a.high[k], b.high[k]);
  }
  if (with_cones) join_cones(a, b);
  a.emission = std::min(a.emission, b.emission);
  a.power += b.power;
}

/// Solid angle that a group emits into, weighted by the cosine past its normals.
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
  LightTreeBuilder(LightTree& tree, const std::vector<LightBounds>& lights) : tree_(tree) {
    lights_.reserve(lights.size());
    for (const LightBounds& light : lights)
      lights_.push_back({light, static_cast<std::uint32_t>(lights_.size())});
    groups_.reserve(2 * lights.size());
    tree_.slots_.resize(lights.size());
    widen(halve(0, static_cast<std::uint32_t>(lights.size()), 0), {});
  }

 private:
  struct Light {
    LightBounds bounds;
    std::uint32_t index = 0;  // the caller's
  };
  /// One light, or two groups.
  struct Group {
    LightBounds bounds;
    std::uint32_t first = 0, second = 0;  // groups; of a light: itself, and `single`
  };
  static constexpr std::uint32_t single = ~std::uint32_t(0);

  struct Bin {
    LightBounds bounds;
    std::uint32_t count = 0;
    void add(const LightBounds& other, std::uint32_t lights, bool with_cones) {
      if (lights == 0) return;
      if (count == 0)
        bounds = other;
      else
        join(bounds, other, with_cones);
      count += lights;
    }
  };

  struct Split {
    double cost = std::numeric_limits<double>::infinity();
    int axis = -1, bin = 0;
  };

  static Vec3 centre(const LightBounds& bounds) { return (bounds.low + bounds.high) * 0.5F; }

  std::uint32_t halve(std::uint32_t first, std::uint32_t last, int depth) {
    if (last - first == 1) {
      groups_.push_back({lights_[first].bounds, lights_[first].index, single});
      return static_cast<std::uint32_t>(groups_.size()) - 1;
    }
    const std::uint32_t middle = divide(first, last, depth);
    const std::uint32_t one = halve(first, middle, depth + 1), other = halve(middle, last, depth + 1);
    Group group{groups_[one].bounds, one, other};
    join(group.bounds, groups_[other].bounds, true);
    groups_.push_back(group);
    return static_cast<std::uint32_t>(groups_.size()) - 1;
  }

  /// Orders [first, last) into two halves and returns where the second begins.
  std::uint32_t divide(std::uint32_t first, std::uint32_t last, int depth) {
    Vec3 low = centre(lights_[first].bounds), high = low;
    for (std::uint32_t i = first; i < last; ++i) {
      const Vec3 c = centre(lights_[i].bounds);
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], c[k]);
        high[k] = std::max(high[k], c[k]);
      }
    }
    Split best;
    for (int axis = 0; axis < 3 && depth < deepest_guided; ++axis) {
      if (high[axis] > low[axis]) consider(first, last, low, high, axis, best);
    }
    if (best.axis >= 0) {
      const auto begin = lights_.begin();
      const auto middle = std::partition(begin + first, begin + last, [&](const Light& light) {
        return bin_of(centre(light.bounds)[best.axis], low[best.axis], high[best.axis]) <= best.bin;
      });
      return static_cast<std::uint32_t>(middle - begin);
    }
    return first + (last - first) / 2;
  }

  static int bin_of(float value, float low, float high) {
    return std::clamp(static_cast<int>(bins * ((value - low) / (high - low))), 0, bins - 1);
  }

  void consider(std::uint32_t first, std::uint32_t last, const Vec3& low, const Vec3& high, int axis,
                Split& best) {
    const bool with_cones = last - first <= most_with_cones;
    std::array<Bin, bins> filled{};
    for (std::uint32_t i = first; i < last; ++i) {
      const LightBounds& light = lights_[i].bounds;
      filled[bin_of(centre(light)[axis], low[axis], high[axis])].add(light, 1, with_cones);
    }
    std::array<double, bins> after{};  // cost of all bins past each
    Bin right;
    for (int b = bins - 1; b > 0; --b) {
      right.add(filled[b].bounds, filled[b].count, with_cones);
      after[b - 1] = right.count > 0 ? cost(right.bounds, high - low, axis) : 0.0;
    }
    Bin left;
    for (int b = 0; b + 1 < bins; ++b) {
      left.add(filled[b].bounds, filled[b].count, with_cones);
      if (left.count == 0 || left.count == last - first) continue;
      const double total = cost(left.bounds, high - low, axis) + after[b];
      if (total < best.cost) best = {total, axis, b};
    }
  }

  /// Makes a node of the groups below `group`: of the widest ones, opened until the lanes are full.
  std::uint32_t widen(std::uint32_t group, LightTree::Slot parent) {
    std::vector<std::uint32_t> open{group};
    while (open.size() < LightTree::lanes) {
      const auto widest = std::max_element(open.begin(), open.end(), [&](std::uint32_t a, std::uint32_t b) {
        return spread_of(groups_[a]) < spread_of(groups_[b]);
      });
      const Group& opened = groups_[*widest];
      if (opened.second == single) break;
      *widest = opened.first;
      open.push_back(opened.second);
    }
    const auto at = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    tree_.parents_.push_back(parent);
    for (std::uint32_t lane = 0; lane < open.size(); ++lane) {
      fill(tree_.nodes_[at], lane, groups_[open[lane]].bounds);
      const Group& below = groups_[open[lane]];
      if (below.second == single) tree_.slots_[below.first] = {at, lane};
      const std::uint32_t child =
          below.second == single ? below.first | LightTree::light_bit : widen(open[lane], {at, lane});
      tree_.nodes_[at].child[lane] = child;
    }
    return at;
  }

  /// Of a single light: less than of any group.
  static double spread_of(const Group& group) {
    if (group.second == single) return -1;
    return double(group.bounds.power) * (group.bounds.high - group.bounds.low).length();
  }

  static void fill(LightTree::Node& node, std::uint32_t lane, const LightBounds& bounds) {
    const Vec3 middle = centre(bounds);
    node.x[lane] = middle.x;
    node.y[lane] = middle.y;
    node.z[lane] = middle.z;
    node.radius2[lane] = (bounds.high - bounds.low).length2() / 4 * 1.00001F;  // corners round
    node.axis_x[lane] = bounds.axis.x;
    node.axis_y[lane] = bounds.axis.y;
    node.axis_z[lane] = bounds.axis.z;
    node.cos_normals[lane] = bounds.normals;
    node.sin_normals[lane] = std::sqrt(std::max(1 - bounds.normals * bounds.normals, 0.0F));
    node.emission[lane] = bounds.emission;
    node.power[lane] = bounds.power;
    node.two_sided[lane] = bounds.two_sided ? 1.0F : 0.0F;
  }

  LightTree& tree_;
  std::vector<Light> lights_;  // in the order of the halves; copies, since they are read over and over
  std::vector<Group> groups_;
};

LightTree::LightTree(const std::vector<LightBounds>& lights) {
  if (!lights.empty()) LightTreeBuilder(*this, lights);
}

}  // namespace rnmbake
