#include "ssbump/generate/generate_bounces.h"

#include "sampling/splitmix64.h"
#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/heights/trace_heights.h"
#include "ssbump/map/lobes.h"

#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

/// A direction with density cosine / pi around the normal: the normal plus a uniform point of the unit
/// sphere.
Vec3d reflected(const Vec3d& normal, SplitMix64& numbers) {
  const double z = 2 * numbers.next_double() - 1, angle = 2 * pi * numbers.next_double();
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  const Vec3d sum = normal + Vec3d(r * std::cos(angle), r * std::sin(angle), z);
  return sum.length2() > 1e-12 ? sum.normalized() : normal;
}

using Sums = std::array<double, SsbumpWeights::channels>;

class Bounces {
 public:
  Bounces(const HeightField& field, const GenerateOptions& options)
      : tracer_(field), options_(options), lobes_(ssbump_lobes(options.power)) {
    for (std::size_t c = 0; c < lobes_.size(); ++c) whole_[c] = lobe_whole(lobes_[c]);
  }

  [[nodiscard]] Sums texel(int x, int y, const std::vector<WeightedRay>& rays, SplitMix64 numbers) const {
    Sums sums{};
    for (const WeightedRay& ray : rays) {
      if (ray.direction.z <= 0) continue;
      if (const auto hit = tracer_.next(tracer_.centre(x, y), Vec3d(ray.direction)))
        follow(*hit, numbers, sums);
    }
    for (std::size_t c = 0; c < sums.size(); ++c)
      sums[c] *= 2 * pi / (whole_[c] * static_cast<double>(rays.size()));
    return sums;
  }

 private:
  void follow(HeightHit hit, SplitMix64& numbers, Sums& sums) const {
    double share = 1;
    for (int bounce = 1; bounce <= options_.bounces; ++bounce) {
      share *= albedo(hit.place);
      const Vec3d direction = reflected(hit.normal, numbers);
      const auto next = tracer_.next(hit.place, direction);
      if (!next) {
        if (direction.z <= 0) return;
        for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += share * lobe_value(lobes_[c], direction);
        return;
      }
      hit = *next;
    }
  }

  [[nodiscard]] double albedo(const HeightPlace& place) const {
    if (options_.albedo_map == nullptr) return options_.albedo;
    const auto [x, y] = tracer_.texel(place);
    return options_.albedo_map->texel(x, y)[0];
  }

  HeightTracer tracer_;
  const GenerateOptions& options_;
  std::array<Lobe, SsbumpWeights::channels> lobes_;
  Sums whole_{};
};

}  // namespace

void add_bounces(const HeightField& field, const GenerateOptions& options, int first_row,
                 SsbumpWeights& weights, const std::function<bool()>& stop) {
  const Bounces bounces(field, options);
  const HemisphereRays rays(options.rays, options.power, options.seed);
  tbb::parallel_for(0, weights.image.height(), [&](int row) {
    if (stop && stop()) return;
    const int y = row + first_row;
    for (int x = 0; x < field.width(); ++x) {
      SplitMix64 numbers((static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint64_t>(x)) *
                             0xd6e8feb86659fd93ULL +
                         options.seed);
      const auto set = static_cast<std::uint64_t>(numbers.next_double() * 0x1p32);
      const Sums more = bounces.texel(x, y, rays.set(set), numbers);
      const auto texel = weights.image.texel(x, row);
      for (std::size_t c = 0; c < more.size(); ++c) texel[c] += static_cast<float>(more[c]);
    }
  });
}

}  // namespace rnmbake
