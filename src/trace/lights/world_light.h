// trace/lights/world_light.h - the environment light: constant, or a picture with importance sampling.
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"
#include "trace/lights/light_sample.h"

#include <vector>

namespace rnmbake {

/// A constant world is sampled over the normal's hemisphere, half of the samples uniformly and half by the
/// cosine: good for the surface and for directions tilted off it. A picture is sampled by brightness x solid
/// angle of its cells; a cell is a texel with the share of its neighbours that bilinear filtering mixes in,
/// so that no light has density 0.
class WorldLight {
 public:
  explicit WorldLight(const DiffuseScene& scene);

  [[nodiscard]] bool black() const { return average_ == 0; }
  [[nodiscard]] bool even() const { return picture_ == nullptr; }
  /// Brightness, averaged over the sphere.
  [[nodiscard]] float average() const { return average_; }
  [[nodiscard]] Vec3 radiance(const Vec3& direction) const;
  /// `extra` in [0,1) chooses between the two densities of a constant world.
  [[nodiscard]] LightSample sample(const Vec3& normal, const Vec2& u, float extra) const;
  [[nodiscard]] float pdf(const Vec3& normal, const Vec3& direction) const;

 private:
  void build_table();
  [[nodiscard]] Vec3 read(const Vec2& uv) const;
  [[nodiscard]] LightSample sample_picture(const Vec2& u) const;
  [[nodiscard]] LightSample sample_constant(const Vec3& normal, const Vec2& u, float extra) const;
  [[nodiscard]] static float constant_pdf(const Vec3& normal, const Vec3& direction);

  Vec3 constant_{0, 0, 0};
  const Texture* picture_ = nullptr;
  float average_ = 0;
  std::vector<float> solid_angles_;  // of a cell in each row
  std::vector<float> rows_;          // running sums over the rows, [height + 1], ends at 1
  std::vector<float> cells_;         // running sums within each row, [height][width + 1], each ends at 1
};

}  // namespace rnmbake
