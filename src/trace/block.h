// trace/block.h - gathers light for a few neighbouring texels at once, which share what their rays found.
//
// Each texel shoots a ray, and the light that the surface it meets sends back is estimated once, by a path.
// That light is the same in every direction, so every texel of the block that sees the place may use it: for
// texel i and the places y_j that the block found,
//     E_i(b) = sum_j  V_ij L(y_j) max(0, D_ij . b) G_ij / sum_k V_kj p_k(y_j),
// with V_ij what see-through surfaces leave of the light, the balance heuristic over the block's ways to find
// y_j (Bekaert, Sbert and Halton, "Accelerating Path Tracing by Re-using Paths", 2002), with p_k the density
// per area, and in place of V_kj there the probability that a path gets through what is see-through on the
// way. It is unbiased, and a shadow ray takes the place of a whole path. Emission and sky that the first rays
// meet, and lamps, stay each texel's own.
#pragma once

#include "sampling/batch_statistics.h"
#include "sampling/cosine_lobes.h"
#include "trace/gather_options.h"
#include "trace/path.h"
#include "trace/texel_samples.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rnmbake {

class BlockGatherer {
 public:
  static constexpr std::size_t texels = 32;  // of a block, at most
  static constexpr std::size_t lamp_samples =
      8;  // for each path: they cost little, and most of the noise is theirs

  /// `own`: where self-reflection is to be made; null: nowhere.
  BlockGatherer(const TraceScene& scene, const TexelSamples& texel_samples, const GatherOptions& options,
                const OwnSurface* own);

  /// Directions, then SH coefficients.
  [[nodiscard]] std::size_t values() const { return directions_ + coefficients_; }

  /// One batch: `samples` for each texel. Another seed is an independent batch.
  void batch(std::span<const TexelSample> block, int samples, std::uint64_t seed,
             BatchStatistics& statistics);

  /// Since the beginning: rays, and of each texel's first rays those that met a back face.
  [[nodiscard]] std::int64_t rays() const { return rays_; }
  [[nodiscard]] const std::vector<std::int64_t>& back_faces() const { return back_faces_; }

 private:
  /// What one texel has in one round.
  struct PathState {
    Vec3 weights, position, face;
    Frame frame;           // orthonormal; its normal is the shading normal
    float ray_offset = 0;  // how far it is off the surface
    Vec3* sums = nullptr;  // of this texel in the tally
  };
  struct SharedVertex {
    Vec3 position, face, target;  // target: where rays to it end, just off the surface
    Vec3 radiance{0, 0, 0};       // sent back, over the probability to stay there; 0: nothing to share
    Visibility way;               // from the finder
  };

  void begin_path(std::size_t i, const TexelSample& texel, Sampler& sampler);
  void look_around(std::size_t i);
  void sample_lamps(std::size_t i, const TexelSample& texel, std::uint64_t seed, int sample);
  void trace_path(std::size_t i, Sampler& sampler);
  void share(std::size_t finder, std::size_t count);
  void add(std::size_t i, const Vec3& direction, const Vec3& light);
  void add_below(std::size_t i, const TexelSample& texel, const LightSample& light);
  void take_color_out(std::size_t i, const TexelSample& texel);

  /// Few enough for a lobe each.
  [[nodiscard]] bool few_directions() const { return directions_ > 0 && directions_ < CosineLobes::most; }
  /// From where light counts: over the face, or (zero) from everywhere.
  [[nodiscard]] Vec3 horizon(std::size_t i) const {
    return recipe_ && recipe_->faults().below_horizon ? Vec3(0) : states_[i].face;
  }

  const TraceScene& scene_;
  const TexelSamples& texel_samples_;
  const GatherOptions& options_;
  const OwnSurface* own_;  // null: no faults
  std::optional<Recipe> recipe_;
  PathOptions path_;
  std::size_t directions_, coefficients_;
  bool framed_;  // whether `PathState` needs its frame
  std::vector<PathState>
      states_;  // [texels + lamp_samples]: the last are where one texel looks at lamps from
  std::vector<CosineLobes> lobes_;
  std::vector<Vec3> normals_;  // [texels + lamp_samples][directions], world space
  std::vector<SharedVertex> shared_vertices_;
  std::int64_t rays_ = 0;
  std::vector<std::int64_t> back_faces_;
};

}  // namespace rnmbake
