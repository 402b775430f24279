#include "ssbump/mesh/mesh_occlusion.h"

#include "sampling/splitmix64.h"
#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

/// Offset of rays' starts off the surface, world units: some 10 times the spacing of floats there, little
/// beside a small mesh.
float lift(const Vec3& position, double diagonal) {
  const double near_origin = std::clamp(1e-3 * diagonal, 1e-6, 1e-5);
  return static_cast<float>(std::max(near_origin, 1e-6 * double(position.length())));
}

constexpr int band_rows = 32;
constexpr int most_backs = 64;  // faces met from behind before a ray gives up
constexpr double cage_share = 0.03;

struct Box {
  Vec3 low = Vec3(std::numeric_limits<float>::max()), high = Vec3(std::numeric_limits<float>::lowest());

  void hold(const Vec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  [[nodiscard]] double diagonal() const { return low.x > high.x ? 0 : Vec3d(high - low).length(); }
};

/// A point of the detail.
struct Detail {
  Vec3 position;
  Vec3 face;    // of its triangle, unit, on the side that was met
  Vec3 normal;  // smooth, on the same side
  float height = 0;
  bool behind = false;
};

/// Sums over the places of a texel.
struct TexelSum {
  SsbumpChannels visible{}, whole{};
  Vec3 normal{0, 0, 0};
  float height = 0;
  int found = 0, behind = 0;
};

class Measurement {
 public:
  Measurement(const HighMesh& high, const MeshOcclusionOptions& options)
      : high_(high),
        options_(options),
        tree_(high.position),
        rays_(std::max(1, options.rays / (options.parts * options.parts)), options.power, options.seed) {
    Box box;
    for (const Vec3& position : high.position) box.hold(position);
    diagonal_ = box.diagonal();
  }

  [[nodiscard]] TexelSum measure(const LowTexel& texel) const {
    TexelSum sum;
    std::uint64_t number = mix64(options_.seed + (std::uint64_t(texel.y) * options_.width + texel.x));
    for (const LowPlace& place : texel.places) {
      ++number;
      const std::optional<Detail> detail = find(place);
      if (!detail) continue;
      ++sum.found;
      sum.behind += detail->behind ? 1 : 0;
      sum.height += detail->height;
      sum.normal += place.frame.to_tangent(detail->normal);
      add_visibility(*detail, place.frame, rays_.set(number), sum);
    }
    return sum;
  }

 private:
  [[nodiscard]] std::optional<Detail> find(const LowPlace& place) const {
    const auto cage = static_cast<float>(options_.cage);
    const Vec3 down = -place.frame.normal, start = place.position - down * cage;
    std::optional<Detail> back;
    float near = 0;
    for (int i = 0; i < most_backs; ++i) {
      const auto hit = tree_.first(start, down, near, 2 * cage);
      if (!hit) break;
      Detail detail = detail_at(*hit, down, cage);
      if (!detail.behind) return detail;
      if (!back) back = detail;
      near = std::nextafter(hit->distance, std::numeric_limits<float>::infinity());
    }
    return back;
  }

  [[nodiscard]] Detail detail_at(const TriangleHit& hit, const Vec3& down, float cage) const {
    const Vec3 *p = &high_.position[3 * std::size_t(hit.triangle)],
               *n = &high_.normal[3 * std::size_t(hit.triangle)];
    const float b0 = 1 - hit.b1 - hit.b2;
    Detail detail;
    detail.position = p[0] * b0 + p[1] * hit.b1 + p[2] * hit.b2;
    detail.face = Vec3(Vec3d(p[1] - p[0]).cross(Vec3d(p[2] - p[0])).normalized());
    detail.normal = n[0] * b0 + n[1] * hit.b1 + n[2] * hit.b2;
    detail.normal = detail.normal.length2() > 0 ? unit(detail.normal) : detail.face;
    detail.height = cage - hit.distance;
    detail.behind = detail.face.dot(down) > 0;
    if (detail.behind) {
      detail.face = -detail.face;
      detail.normal = -detail.normal;
    }
    return detail;
  }

  void add_visibility(const Detail& detail, const Frame& frame, const std::vector<WeightedRay>& rays,
                      TexelSum& sum) const {
    const float far =
        options_.reach > 0 ? static_cast<float>(options_.reach) : std::numeric_limits<float>::infinity();
    const Vec3 origin = detail.position + detail.face * lift(detail.position, diagonal_);
    for (const WeightedRay& ray : rays) {
      const Vec3 direction = frame.to_world(ray.direction);
      const bool visible = direction.dot(detail.face) > 0 && !tree_.blocked(origin, direction, far);
      for (std::size_t c = 0; c < sum.whole.size(); ++c) {
        sum.whole[c] += ray.weight[c];
        if (visible) sum.visible[c] += ray.weight[c];
      }
    }
  }

  const HighMesh& high_;
  const MeshOcclusionOptions& options_;
  TriangleTree tree_;
  HemisphereRays rays_;
  double diagonal_ = 0;
};

void store(const LowTexel& texel, const TexelSum& sum, MeshOcclusion& out) {
  out.covered.texel(texel.x, texel.y)[0] = 1;
  if (sum.found == 0) return;
  out.found.texel(texel.x, texel.y)[0] = 1;
  const auto weights = out.weights.image.texel(texel.x, texel.y);
  for (std::size_t c = 0; c < weights.size(); ++c)
    weights[c] = sum.whole[c] > 0 ? sum.visible[c] / sum.whole[c] : 1.0F;
  const Vec3 normal = sum.normal.length2() > 0 ? unit(sum.normal) : Vec3(0, 0, 1);
  std::copy_n(&normal.x, 3, out.normal.texel(texel.x, texel.y).begin());
  out.height.texel(texel.x, texel.y)[0] = sum.height / static_cast<float>(sum.found);
}

void count(const LowTexel& texel, const TexelSum& sum, SurfaceMisses& misses) {
  ++misses.texels;
  misses.behind += static_cast<std::size_t>(sum.behind);
  if (sum.found > 0) return;
  if (misses.missed++ > 0) return;
  misses.missed_x = texel.x;
  misses.missed_y = texel.y;
}

MeshOcclusion blank(const MeshOcclusionOptions& options, std::size_t surfaces) {
  const int w = options.width, h = options.height;
  return {{FloatImage(w, h, SsbumpWeights::channels)},
          FloatImage(w, h, 1),
          FloatImage(w, h, 1),
          FloatImage(w, h, 3),
          FloatImage(w, h, 1),
          std::vector<SurfaceMisses>(surfaces)};
}

}  // namespace

MeshOcclusion measure_occlusion(const HighMesh& high, std::span<const LowSurface> low,
                                const MeshOcclusionOptions& options,
                                const std::function<bool(double)>& go_on) {
  MeshOcclusion out = blank(options, low.size());
  const Measurement measurement(high, options);
  const LowTexels texels(low, options.width, options.height, options.parts);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  for (int row = 0; row < options.height; row += band_rows) {
    if (go_on && !go_on(double(row) / options.height)) break;
    const auto band = texels.band(row, std::min(band_rows, options.height - row));
    std::vector<TexelSum> sums(band.size());
    arena.execute([&] {
      tbb::parallel_for(std::size_t(0), band.size(),
                        [&](std::size_t i) { sums[i] = measurement.measure(band[i]); });
    });
    for (std::size_t i = 0; i < band.size(); ++i) {
      store(band[i], sums[i], out);
      count(band[i], sums[i], out.surfaces[band[i].surface]);
    }
  }
  return out;
}

double default_cage(std::span<const LowSurface> low) {
  Box box;
  for (const LowSurface& one : low) {
    for (const SurfaceTriangle& triangle : one.surface.triangles) {
      for (const SurfaceCorner& corner : triangle.corners) box.hold(corner.position);
    }
  }
  return cage_share * box.diagonal();
}

}  // namespace rnmbake
