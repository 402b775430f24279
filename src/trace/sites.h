// trace/sites.h - the places on a target where light is gathered: one for each covered texel.
#pragma once

#include "base/math.h"
#include "scene/surface.h"
#include "trace/gather.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// A covered texel.
struct TexelSite {
  std::uint16_t x = 0, y = 0;
  std::uint32_t triangle = 0;  // of the Surface
  float b1 = 0, b2 = 0;        // of the texel's centre
};

/// A place within a texel's footprint, and the frame there.
struct Place {
  Vec3 position;
  Vec3 face;  // geometric normal, unit
  Frame
      frame;  // interpolated, not normalised: what it makes of a basis vector is, as a runtime shader has it
};

class Sites {
 public:
  Sites(const Surface& surface, int width, int height, Footprint footprint);

  /// Neighbours in the list are neighbours on the map.
  [[nodiscard]] const std::vector<TexelSite>& texels() const { return texels_; }

  /// `u` in [0,1)^2 chooses the place in the footprint. Past a triangle's edge the place is mirrored back in,
  /// as Cycles does it.
  [[nodiscard]] Place place(const TexelSite& texel, const Vec2& u) const;

 private:
  /// How barycentric weights change from one texel to the next.
  struct Slope {
    Vec2 along_x, along_y;
  };
  const Surface& surface_;
  std::vector<TexelSite> texels_;
  std::vector<Slope> slopes_;  // [triangles of the surface]
};

}  // namespace rnmbake
