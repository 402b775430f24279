// trace/texel_samples.h - the covered texels of a target as points to gather light at.
#pragma once

#include "base/math.h"
#include "scene/surface.h"
#include "trace/gather_options.h"
#include "trace/gather_point.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// A covered texel.
struct TexelSample {
  std::uint16_t x = 0, y = 0;
  std::uint32_t triangle = 0;  // of the Surface
  float b1 = 0, b2 = 0;        // barycentric, of the texel's centre
};

class TexelSamples : public PointSource {
 public:
  TexelSamples(const Surface& surface, int width, int height, Footprint footprint, PastEdge past_edge);

  /// Neighbours in the list are neighbours on the map.
  [[nodiscard]] const std::vector<TexelSample>& texels() const { return texels_; }

  [[nodiscard]] std::size_t size() const override { return texels_.size(); }
  [[nodiscard]] GatherPoint sample(std::size_t texel, const Vec2& u) const override;

 private:
  /// How barycentric coordinates change from one texel to the next.
  struct Slope {
    Vec2 along_x, along_y;
    /// Of corners 1 and 2, at a point of the footprint; below 0 past an edge.
    [[nodiscard]] Vec2 barycentric(const TexelSample& texel, const Vec2& u) const {
      return Vec2(texel.b1, texel.b2) + along_x * (u.x - 0.5F) + along_y * (u.y - 0.5F);
    }
  };
  /// Barycentric coordinates of a point of the footprint, moved into the triangle.
  [[nodiscard]] Vec3 mirrored(const TexelSample& texel, const Vec2& u) const;
  [[nodiscard]] Vec3 retried(const TexelSample& texel, Vec2 u) const;

  const Surface& surface_;
  PastEdge past_edge_;
  std::vector<TexelSample> texels_;
  std::vector<Slope> slopes_;  // [triangles of the surface]
};

}  // namespace rnmbake
