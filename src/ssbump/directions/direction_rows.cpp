#include "ssbump/directions/direction_rows.h"

#include "base/error.h"
#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/map/normals.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int rays_for_each = 8;
constexpr int ray_set_count = 64;

std::vector<Vec3> axes_of(const BasisSet& set) {
  std::vector<Vec3> axes;
  for (const BasisDirection& basis : set.directions) axes.push_back(basis.direction);
  return axes;
}

/// Neighbouring texels take unlike sets.
std::size_t ray_set_of(int x, int y) {
  const auto a = static_cast<std::uint64_t>(x), b = static_cast<std::uint64_t>(y);
  const std::uint64_t mixed = (a * 0x9e3779b97f4a7c15ULL) ^ (b * 0xc2b2ae3d27d4eb4fULL);
  return ((mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9ULL >> 32) % ray_set_count;
}

}  // namespace

DirectionRows::DirectionRows(const HeightField& field, DirectionOptions options)
    : field_(field), options_(std::move(options)), surface_(field) {
  const int least = rays_for_each * static_cast<int>(options_.set.directions.size());
  if (options_.rays < least)
    fail(ExitCode::usage, "{} rays do not tell {} directions apart; give --rays {} or more", options_.rays,
         options_.set.directions.size(), least);
  const HemisphereRays rays(options_.rays, 1, options_.seed);
  const std::vector<Vec3> axes = axes_of(options_.set);
  for (std::uint64_t i = 0; i < ray_set_count; ++i) {
    std::vector<Vec3> directions;
    for (const WeightedRay& ray : rays.set(i)) directions.push_back(ray.direction);
    sets_.push_back({directions, DirectionWeights(axes, directions)});
  }
}

FloatImage DirectionRows::rows(int first_row, int last_row, const std::function<bool()>& stop) const {
  const FloatImage normals = height_normals(field_, first_row, last_row);
  FloatImage weights(field_.width(), last_row - first_row, static_cast<int>(options_.set.directions.size()));
  tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, weights.height(), [&](int row) {
      if (stop && stop()) return;
      std::vector<float> response(static_cast<std::size_t>(options_.rays));
      for (int x = 0; x < field_.width(); ++x) {
        const int y = row + first_row;
        const RaySet& set = sets_[ray_set_of(x, y)];
        const Vec3 normal = vec3_at(normals, x, row);
        std::ranges::transform(set.directions, response.begin(), [&](const Vec3& direction) {
          const float cosine = direction.dot(normal);
          return cosine > 0 && !surface_.occluded(x, y, direction) ? cosine : 0;
        });
        set.weights.solve(response, options_.sign, weights.texel(x, row));
      }
    });
  });
  return weights;
}

}  // namespace rnmbake
