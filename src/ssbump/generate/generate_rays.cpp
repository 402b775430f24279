#include "ssbump/generate/generate_rays.h"

#include "encoding/rnm.h"
#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/heights/height_shadows.h"

#include <array>
#include <atomic>
#include <vector>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

constexpr float cone_cosine = 0.5F;  // half of 120 degrees

/// Weight of a ray in each cone: the same for all directions within it. Ambient is no cone.
SsbumpChannels in_cones(const WeightedRay& ray) {
  const auto basis = rnm_basis();
  SsbumpChannels weight{};
  for (std::size_t c = 0; c < basis.size(); ++c)
    weight[c] = ray.direction.dot(basis[c]) >= cone_cosine ? 1.0F : 0.0F;
  weight[SsbumpWeights::up] = ray.direction.z >= cone_cosine ? 1.0F : 0.0F;
  weight[SsbumpWeights::ambient] = ray.weight[SsbumpWeights::ambient];
  return weight;
}

/// Neighbouring texels take unlike sets.
std::uint64_t set_of(int x, int y) {
  const auto a = static_cast<std::uint64_t>(x), b = static_cast<std::uint64_t>(y);
  const std::uint64_t mixed = (a * 0x9e3779b97f4a7c15ULL) ^ (b * 0xc2b2ae3d27d4eb4fULL);
  return (mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9ULL >> 32;
}

void trace_texel(const HeightRays& surface, const std::vector<WeightedRay>& rays, bool cones, int x, int y,
                 std::span<float> out) {
  std::array<double, SsbumpWeights::channels> seen{}, all{};
  for (const WeightedRay& ray : rays) {
    const SsbumpChannels weight = cones ? in_cones(ray) : ray.weight;
    const bool free = !surface.occluded(x, y, ray.direction);
    for (std::size_t c = 0; c < all.size(); ++c) {
      all[c] += weight[c];
      if (free) seen[c] += weight[c];
    }
  }
  for (std::size_t c = 0; c < all.size(); ++c)
    out[c] = all[c] > 0 ? static_cast<float>(seen[c] / all[c]) : 1.0F;
}

}  // namespace

SsbumpWeights rays_rows(const HeightField& field, const GenerateOptions& options, int first_row, int last_row,
                        const std::function<void(double)>& progress, const std::function<bool()>& stop) {
  const HeightRays surface(field);
  const HemisphereRays rays(options.rays, options.power, options.seed);
  SsbumpWeights weights{FloatImage(field.width(), last_row - first_row, SsbumpWeights::channels)};
  std::atomic<int> done = 0;
  tbb::parallel_for(first_row, last_row, [&](int y) {
    if (stop && stop()) return;
    for (int x = 0; x < field.width(); ++x)
      trace_texel(surface, rays.set(set_of(x, y)), options.method == SsbumpMethod::cone, x, y,
                  weights.image.texel(x, y - first_row));
    if (progress) progress(double(++done) / (last_row - first_row));
  });
  return weights;
}

}  // namespace rnmbake
