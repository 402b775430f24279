// trace/gather_point.h - where light is gathered: points with their frames, from any source.
#pragma once

#include "base/math.h"
#include "scene/tangents.h"

#include <cstddef>
#include <cstdint>

namespace rnmbake {

/// A point to gather light at, relative to TraceScene::origin().
struct GatherPoint {
  Vec3 position;
  Vec3 face;  // geometric normal, unit: only light from its side counts
  /// Tangent space of the basis directions; interpolated, not normalised, as in a runtime shader.
  Frame frame;
  /// On a target's Surface, which the recipe's faults need; points in free space leave them as they are.
  std::uint32_t triangle = 0;
  Vec3 barycentric{1, 0, 0};
};

/// A list of points to gather at, each with a footprint that its light is averaged over: the texels of a
/// target (TexelSamples), or points in free space. Thread-safe.
class PointSource {
 public:
  virtual ~PointSource() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// Maps `u` in [0,1)^2 to a point of the footprint.
  [[nodiscard]] virtual GatherPoint sample(std::size_t index, const Vec2& u) const = 0;

 protected:
  PointSource() = default;
  PointSource(const PointSource&) = default;
  PointSource& operator=(const PointSource&) = default;
};

}  // namespace rnmbake
