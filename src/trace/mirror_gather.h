// trace/mirror_gather.h - a target's indirect light out of radiance that another renderer finds along rays of
// ours.
//
// Rays start at all texels, in directions that suit the lobes that are wanted; for each the other renderer
// says what reflected light arrives along it, whatever materials stand there. We know where the ray ends, so
// where that surface sends the same to all sides its light serves a whole block of texels, by the estimator
// of trace/block.h; elsewhere it serves its own texel alone. Unbiased either way, and any number of
// directions costs one ray.
#pragma once

#include "trace/block.h"
#include "trace/gather_options.h"
#include "trace/scene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rnmbake {

class MirrorGather {
 public:
  /// `scene`: all surfaces that diffuse and reflected rays meet, opaque; lights in it do not count. `even`:
  /// [materials of the scene], 1: the radiance that it reflects is the same to all sides of it that see it.
  /// `options.samples`: rays of each texel. Keeps references.
  MirrorGather(const TraceScene& scene, std::span<const char> even, const GatherTarget& target,
               const GatherOptions& options);
  ~MirrorGather();

  /// Number of rays.
  [[nodiscard]] std::size_t size() const;

  /// All rays, relative to the scene's origin; the same for the same target and options.
  [[nodiscard]] std::vector<PrimaryRay> rays() const;

  struct Result {
    Gathered light;                    // without standard errors
    std::int64_t lit = 0, shared = 0;  // rays with light, and those whose light was shared
  };
  /// `radiance`: [size()] reflected light that arrives along each ray, emission that is met at once left out.
  [[nodiscard]] Result gather(std::span<const Vec3> radiance) const;

 private:
  struct Work;
  std::unique_ptr<const Work> work_;
};

}  // namespace rnmbake
