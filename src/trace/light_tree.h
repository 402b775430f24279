// trace/light_tree.h - chooses one of many lights by what each may send to a point (Conty Estevez & Kulla
// 2018).
#pragma once

#include "base/math.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// Where a light, or a group of them, is, which way it shines and how strongly.
struct LightBounds {
  Vec3 low{0, 0, 0}, high{0, 0, 0};
  Vec3 axis{0, 0, 1};      // unit; all normals lie within `normals` of it,
  float normals = -1;      // as a cosine,
  float emission = 0;      // and light leaves within this of a normal, as a cosine
  float power = 0;         // largest radiant intensity; > 0
  bool two_sided = false;  // emits along -axis, too
};

/// About the irradiance that it gives: an upper bound for the direction and the angles, softened towards the
/// horizon, because normals that tilt see light there well. 0 only where nothing can arrive. `normal` as in
/// Lights.
[[nodiscard]] float light_importance(const LightBounds& bounds, const Vec3& point, const Vec3& normal);

class LightTree {
 public:
  static constexpr std::uint32_t few_lights = 8;  // so few are weighed one by one

  LightTree() = default;
  explicit LightTree(const std::vector<LightBounds>& lights);

  [[nodiscard]] bool empty() const { return lights_.empty(); }
  /// Of all lights together.
  [[nodiscard]] float importance(const Vec3& point, const Vec3& normal) const;

  struct Choice {
    std::uint32_t light = 0;  // index into what the tree was made of
    float probability = 0;    // 0: no light reaches the point
  };
  /// `u` in [0,1) decides, and comes back as an even number in [0,1) that may be used again.
  [[nodiscard]] Choice choose(const Vec3& point, const Vec3& normal, float& u) const;
  /// With which choose() finds that light.
  [[nodiscard]] float probability(const Vec3& point, const Vec3& normal, std::uint32_t light) const;

 private:
  struct Node {
    LightBounds bounds;
    std::uint32_t first = 0;  // leaf: of lights_; else the second child, the first one follows its parent
    std::uint32_t count = 0;  // of a leaf's lights; 0: not a leaf
  };
  struct Place {
    std::uint64_t trail = 0;  // the turns from the root, lowest bit first: 1 for the second child
    std::uint32_t slot = 0;   // in lights_
  };
  friend class LightTreeBuilder;

  std::vector<Node> nodes_;
  std::vector<LightBounds> lights_;     // in the order of the leaves
  std::vector<std::uint32_t> indices_;  // [lights_] -> caller's index
  std::vector<Place> places_;           // [caller's index]
};

}  // namespace rnmbake
