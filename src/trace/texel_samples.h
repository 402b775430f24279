// trace/texel_samples.h - the places on a target where light is gathered: one for each covered texel.
#pragma once

#include "base/math.h"
#include "scene/surface.h"
#include "trace/gather_options.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// A covered texel.
struct TexelSample {
  std::uint16_t x = 0, y = 0;
  std::uint32_t triangle = 0;  // of the Surface
  float b1 = 0, b2 = 0;        // of the texel's centre
};

/// A place within a texel's footprint, and the frame there.
struct Place {
  Vec3 weights;  // barycentric
  Vec3 position;
  Vec3 face;  // geometric normal, unit
  Frame
      frame;  // interpolated, not normalised: what it makes of a basis vector is, as a runtime shader has it
};

class TexelSamples {
 public:
  TexelSamples(const Surface& surface, int width, int height, Footprint footprint, PastEdge past_edge);

  /// Neighbours in the list are neighbours on the map.
  [[nodiscard]] const std::vector<TexelSample>& texels() const { return texels_; }

  /// `u` in [0,1)^2 chooses the place in the footprint.
  [[nodiscard]] Place place(const TexelSample& texel, const Vec2& u) const;

 private:
  /// How barycentric weights change from one texel to the next.
  struct Slope {
    Vec2 along_x, along_y;
    /// Of the second and the third corner, at a place in the footprint; below 0 past an edge.
    [[nodiscard]] Vec2 weights(const TexelSample& texel, const Vec2& u) const {
      return Vec2(texel.b1, texel.b2) + along_x * (u.x - 0.5F) + along_y * (u.y - 0.5F);
    }
  };
  /// Barycentric weights of a place, all of them 0 or more.
  [[nodiscard]] Vec3 mirrored(const TexelSample& texel, const Vec2& u) const;
  [[nodiscard]] Vec3 retried(const TexelSample& texel, Vec2 u) const;

  const Surface& surface_;
  PastEdge past_edge_;
  std::vector<TexelSample> texels_;
  std::vector<Slope> slopes_;  // [triangles of the surface]
};

}  // namespace rnmbake
