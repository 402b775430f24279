// trace/block.h - gathers light at a block of neighbouring points, which share the vertices their paths find.
//
// A path starts at each point (of a texel, or in free space). The radiance reflected at its first vertex is
// the same in every direction, so every point of the block that sees the vertex may use it: for point i and
// the vertices y_j that the block found,
//     E_i(b) = sum_j  V_ij L(y_j) max(0, D_ij . b) G_ij / sum_k V_kj p_k(y_j),
// with V_ij the transmittance between them, G_ij the geometry term, and the balance heuristic over the points
// that could have found y_j (Bekaert, Sbert and Halton, "Accelerating Path Tracing by Re-using Paths", 2002):
// p_k is the density per area, and in its sum V_kj is the probability that a path passes the see-through
// surfaces between. The estimate is unbiased, and a shadow ray replaces a whole path. Emission and sky that
// the primary rays hit, and next-event estimation of lamps, are not shared.
#pragma once

#include "sampling/batch_statistics.h"
#include "sampling/cosine_lobes.h"
#include "trace/gather_options.h"
#include "trace/gather_point.h"
#include "trace/path.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rnmbake {

/// A primary ray, relative to TraceScene::origin(), and the normal of the face that it starts at.
struct PrimaryRay {
  Vec3 origin, direction, face;
};

/// Primary rays that another renderer follows (trace/mirror_gather.h): a first round lists them, a second one
/// with the same seed takes what came back along them, in the same order.
struct Incident {
  std::vector<PrimaryRay>* asked = nullptr;  // rays are appended; null: the second round
  std::span<const Vec3> radiance;            // reflected light that arrives along each
  std::span<const char> even;  // [materials of the scene] whether they send the same to all sides
};

class BlockGatherer {
 public:
  static constexpr std::size_t most_points = 32;
  /// For each path: shadow rays cost little, and most of the noise comes from the choice of lamps.
  static constexpr std::size_t lamp_samples = 8;

  /// `own`: the target, where recipe faults are to be made; null: none are. `incident`: where reflected light
  /// comes from, all the light there is then; null: from paths.
  BlockGatherer(const TraceScene& scene, const PointSource& points, const GatherOptions& options,
                const OwnSurface* own, const Incident* incident = nullptr);

  /// Number of estimates for each point: directions, then SH coefficients.
  [[nodiscard]] std::size_t values() const { return directions_ + coefficients_; }

  /// Adds one batch for the `count` points from `first` on: `samples` for each. Another seed gives an
  /// independent batch.
  void batch(std::size_t first, std::size_t count, int samples, std::uint64_t seed,
             BatchStatistics& statistics);

  /// Since construction: rays traced, and for each point the primary rays that hit a back face.
  [[nodiscard]] std::int64_t rays() const { return rays_; }
  [[nodiscard]] const std::vector<std::int64_t>& back_faces() const { return back_faces_; }
  /// ... of `incident`, rays with light, and those of them whose light the block shared.
  [[nodiscard]] std::int64_t lit() const { return lit_; }
  [[nodiscard]] std::int64_t shared() const { return shared_; }

 private:
  /// A point during one sample.
  struct PointState {
    GatherPoint point;     // its frame made orthonormal, with the shading normal
    Vec3 origin;           // of its rays: off the face
    float ray_offset = 0;  // by so much
    Vec3* sums = nullptr;  // of its estimates in the batch
  };
  struct SharedVertex {
    Vec3 position, face, target;  // target: where rays to it end, just off the surface
    Vec3 radiance{0, 0, 0};       // reflected, over the probability to stop there; 0: nothing to share
    Visibility visibility;        // from the point that found it
  };

  void start_sample(std::size_t i, std::size_t index, Sampler& sampler);
  void set_lobes(std::size_t i);
  void sample_lamps(std::size_t i, std::size_t index, std::uint64_t seed, int sample);
  void trace_path(std::size_t i, Sampler& sampler);
  void follow_elsewhere(std::size_t i, const Vec3& direction, float pdf);
  void share(std::size_t finder, std::size_t count);
  void add(std::size_t i, const Vec3& direction, const Vec3& light);
  void add_below(std::size_t i, const LightSample& light);
  void apply_no_diffuse(std::size_t i, std::size_t index);

  /// Whether each direction gets a cosine lobe of its own.
  [[nodiscard]] bool few_directions() const { return directions_ > 0 && directions_ < CosineLobes::most; }
  /// The normal of the hemisphere that lights are sampled for; zero: the whole sphere.
  [[nodiscard]] Vec3 horizon(std::size_t i) const {
    return recipe_ && recipe_->faults().below_horizon ? Vec3(0) : states_[i].point.face;
  }

  const TraceScene& scene_;
  const PointSource& points_;
  const GatherOptions& options_;
  const OwnSurface* own_;  // null: no faults
  const Incident* incident_;
  std::size_t next_incident_ = 0;
  std::optional<Recipe> recipe_;
  PathOptions path_;
  std::size_t directions_, coefficients_;
  bool framed_;  // whether points need their frames
  std::vector<PointState>
      states_;  // [most_points + lamp_samples]: the last are the lamp samples of one point
  std::vector<CosineLobes> lobes_;  // [states_]: primary rays are sampled from these
  std::vector<Vec3> normals_;       // [states_][directions], world space
  std::vector<SharedVertex> shared_vertices_;
  std::int64_t rays_ = 0, lit_ = 0, shared_ = 0;
  std::vector<std::int64_t> back_faces_;
};

}  // namespace rnmbake
