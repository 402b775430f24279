// ssbump/mesh/low_texels.h - the texels that low-poly surfaces cover on the one picture they share.
#pragma once

#include "base/math.h"
#include "scene/surface.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// Low-poly surface: an object's triangles with the UVs and the tangent frames of its normal map.
struct LowSurface {
  std::string name;
  Surface surface;
};

/// A place on a low-poly surface. The frame is orthonormal: normal interpolated, tangent made perpendicular.
struct LowPlace {
  Vec3 position;
  Frame frame;
};

/// A covered texel with the places that stand for it: those of its k x k parts whose centre lies in a face.
struct LowTexel {
  int x = 0, y = 0;
  std::size_t surface = 0;  // of the last place
  std::vector<LowPlace> places;
};

/// Finds them a band of rows at a time, so that big pictures with many parts need little memory.
class LowTexels {
 public:
  /// The surfaces must outlive it. Where texels are covered twice the last triangle has them.
  LowTexels(std::span<const LowSurface> surfaces, int width, int height, int parts)
      : surfaces_(surfaces), width_(width), height_(height), parts_(parts) {}

  /// Row by row, left to right.
  [[nodiscard]] std::vector<LowTexel> band(int first_row, int rows) const;

 private:
  std::span<const LowSurface> surfaces_;
  int width_, height_, parts_;
};

/// Two surfaces (or one and itself) with texels in common.
struct UvOverlap {
  std::size_t first = 0, second = 0;
  std::size_t texels = 0;
};

struct UvUse {
  std::vector<std::size_t> texels;  // [surfaces]: how many each covers
  std::vector<UvOverlap> overlaps;  // the largest first
};

[[nodiscard]] UvUse uv_use(std::span<const LowSurface> surfaces, int width, int height);

}  // namespace rnmbake
