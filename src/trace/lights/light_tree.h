// trace/lights/light_tree.h - chooses one of many lights by a bound of its irradiance at a point.
//
// Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting" (2018).
#pragma once

#include "base/math.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Bounds of a light or a group of lights: box, cone of normals, emission.
struct LightBounds {
  Vec3 low{0, 0, 0}, high{0, 0, 0};
  Vec3 axis{0, 0, 1};      // of the cone of normals, unit
  float normals = -1;      // cosine of its half angle
  float emission = 0;      // cosine of the largest angle between a normal and emitted light
  float power = 0;         // largest radiant intensity; > 0
  bool two_sided = false;  // emits along -axis, too
};

class LightTree {
 public:
  LightTree() = default;
  explicit LightTree(const std::vector<LightBounds>& lights);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }

  /// Estimate of the irradiance of all lights together; 0 where no light arrives. `normal` as in Lights.
  [[nodiscard]] float importance(const Vec3& point, const Vec3& normal) const;

  struct Choice {
    std::uint32_t light = 0;  // index into what the tree was made of
    float probability = 0;    // 0: no light arrives
  };
  /// Consumes `u` in [0,1) and replaces it by a number uniform in [0,1) that may be used again.
  [[nodiscard]] Choice choose(const Vec3& point, const Vec3& normal, float& u) const;
  /// Of choose() returning that light.
  [[nodiscard]] float probability(const Vec3& point, const Vec3& normal, std::uint32_t light) const;

  static constexpr std::uint32_t lanes = 8;

 private:
  /// Up to eight lights or groups side by side, for SIMD. A lane without power is empty.
  struct alignas(32) Node {
    std::array<float, lanes> x{}, y{}, z{}, radius2{};                  // the sphere around it
    std::array<float, lanes> axis_x{}, axis_y{}, axis_z{};              // of its cone of normals,
    std::array<float, lanes> cos_normals{}, sin_normals{}, emission{};  // as in LightBounds
    std::array<float, lanes> power{}, two_sided{};                      // 1 or 0
    std::array<std::uint32_t, lanes> child{};                           // a node; with `light_bit`, a light
  };
  struct Slot {
    std::uint32_t node = 0, lane = 0;
  };
  using Weights = std::array<float, lanes>;
  static constexpr std::uint32_t light_bit = std::uint32_t(1) << 31;
  friend class LightTreeBuilder;

  static float weigh(const Node& node, const Vec3& point, const Vec3& normal, Weights& weights);

  std::vector<Node> nodes_;    // the root first
  std::vector<Slot> parents_;  // [nodes_]; of the root: itself
  std::vector<Slot> slots_;    // [lights]
};

}  // namespace rnmbake
