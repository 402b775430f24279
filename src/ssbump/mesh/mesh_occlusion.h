// ssbump/mesh/mesh_occlusion.h - occlusion of a detailed surface by itself, for the texels of a coarse one.
#pragma once

#include "base/math.h"
#include "image/float_image.h"
#include "ssbump/map/weights.h"
#include "ssbump/mesh/low_texels.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rnmbake {

/// The detail: triangles in world space, corners anti-clockwise seen from the front. Needs no UVs.
struct HighMesh {
  std::vector<Vec3> position;  // [3 x triangles]
  std::vector<Vec3> normal;    // [3 x triangles], smooth, unit; for the normal map
};

struct MeshOcclusionOptions {
  int width = 0, height = 0;
  double cage = 0;   // world units along the low surface's normal, outward and inward: where detail is sought
  double reach = 0;  // world units within which something casts a shadow; 0: any distance
  int rays = 250;    // over the hemisphere, for each texel
  int parts = 2;     // a texel is the mean over parts x parts places in it
  double power = 1;  // as in ssbump/map/weights.h
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores
};

/// Texels of a low surface without detail within the cage.
struct SurfaceMisses {
  std::size_t texels = 0;          // that it covers
  std::size_t missed = 0;          // with no detail at any of their places
  std::size_t behind = 0;          // places that found nothing but the back of a face
  int missed_x = 0, missed_y = 0;  // a missed texel, the first one
};

struct MeshOcclusion {
  SsbumpWeights weights;
  FloatImage covered;                   // one channel, 0 or 1: the texel lies in a face of a low surface
  FloatImage found;                     // one channel, 0 or 1: and detail was found there
  FloatImage normal;                    // three: the detail's normal in the low surface's tangent space, unit
  FloatImage height;                    // one: the detail's height over the low surface, world units
  std::vector<SurfaceMisses> surfaces;  // [low surfaces]
};

/// From each place on a low surface a ray runs against the interpolated normal, from one cage distance above
/// it to one below; the first face that it meets from its front is the detail there (a back where there is no
/// front). From that point rays run over the hemisphere above the low surface's tangent plane, whose axes are
/// its interpolated tangent frame; those that enter the detail's own face are blocked. Texels without a value
/// are 0. Deterministic for a seed at any number of threads. Calls `go_on` now and then with the share done;
/// where it returns false, returns the texels done so far. Throws Error(environment) where Embree fails.
[[nodiscard]] MeshOcclusion measure_occlusion(const HighMesh& high, std::span<const LowSurface> low,
                                              const MeshOcclusionOptions& options,
                                              const std::function<bool(double)>& go_on = {});

/// 3 % of the diagonal of the box around the low surfaces.
[[nodiscard]] double default_cage(std::span<const LowSurface> low);

}  // namespace rnmbake
