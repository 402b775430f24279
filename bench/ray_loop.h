// bench/ray_loop.h - a tight loop of Embree's occlusion rays over the same heights, to time sweeps against.
#pragma once

#include "rays/embree_scene.h"
#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/map/weights.h"

#include <array>
#include <vector>

namespace rnmbake {

/// Texels are taken in squares whose rays have the same directions: eight neighbours' rays of one direction
/// after the other, so that a packet is coherent and stays in the same part of the tree.
class RayLoop {
 public:
  static constexpr int tile = 16;  // side of a square
  enum class Packet { one, eight };

  /// Two triangles for each patch, in one static mesh that goes on `margin` texels past each border.
  RayLoop(const HeightField& field, int margin);

  [[nodiscard]] int tiles_across() const { return field_.width() / tile; }
  [[nodiscard]] int tile_rows() const { return field_.height() / tile; }

  /// The weights of a row of squares. `weights` has the field's size.
  void trace_row(int tile_row, const HemisphereRays& rays, Packet packet, SsbumpWeights& weights) const;

  /// The same of the square that texel (x, y) lies in.
  void trace_square(int x, int y, const HemisphereRays& rays, Packet packet, SsbumpWeights& weights) const;

  /// Weights of a single texel, for many rays.
  [[nodiscard]] std::array<double, SsbumpWeights::channels> texel(int x, int y,
                                                                  const std::vector<WeightedRay>& rays) const;

 private:
  struct Square;
  void build(int margin);
  [[nodiscard]] Vec3 origin(int x, int y) const;

  const HeightField& field_;
  EmbreeScene embree_;
};

}  // namespace rnmbake
