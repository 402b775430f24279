// trace/lights/world_light.h - light from where nothing is hit: constant, or a picture sampled by what it
// holds.
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"
#include "trace/lights/light_sample.h"

#include <vector>

namespace rnmbake {

/// A constant world is sampled on the normal's side only, half of the samples evenly and half by cosine: fit
/// for a surface and for normals that tilt away from it. A picture is sampled by brightness x solid angle of
/// its cells; a cell is a texel with its share of the neighbours that bilinear reading mixes in, so that
/// nothing that shines goes unsampled.
class WorldLight {
 public:
  explicit WorldLight(const DiffuseScene& scene);

  [[nodiscard]] bool black() const { return average_ == 0; }
  [[nodiscard]] bool even() const { return picture_ == nullptr; }
  /// Brightness, averaged over the sphere.
  [[nodiscard]] float average() const { return average_; }
  [[nodiscard]] Vec3 radiance(const Vec3& direction) const;
  /// `extra` in [0,1) chooses between the ways to sample.
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
