#include "ssbump/directions/direction_rows.h"

#include "base/error.h"
#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/heights/height_shadows.h"
#include "ssbump/map/normals.h"

#include <algorithm>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int rays_for_each = 8;
constexpr int ray_set_count = 64;

/// Directions of a texel's rays, and the weights that fit what it sees along them.
struct RaySet {
  std::vector<Vec3> directions;
  DirectionWeights weights;
};

std::vector<Vec3> axes_of(const BasisSet& set) {
  std::vector<Vec3> axes;
  for (const BasisDirection& basis : set.directions) axes.push_back(basis.direction);
  return axes;
}

std::vector<RaySet> ray_sets(const DirectionOptions& options) {
  const HemisphereRays rays(options.rays, 1, options.seed);
  std::vector<RaySet> sets;
  for (std::uint64_t i = 0; i < ray_set_count; ++i) {
    std::vector<Vec3> directions;
    for (const WeightedRay& ray : rays.set(i)) directions.push_back(ray.direction);
    sets.push_back({directions, DirectionWeights(axes_of(options.set), directions)});
  }
  return sets;
}

/// Neighbouring texels take unlike sets.
std::size_t ray_set_of(int x, int y) {
  const auto a = static_cast<std::uint64_t>(x), b = static_cast<std::uint64_t>(y);
  const std::uint64_t mixed = (a * 0x9e3779b97f4a7c15ULL) ^ (b * 0xc2b2ae3d27d4eb4fULL);
  return ((mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9ULL >> 32) % ray_set_count;
}

}  // namespace

FloatImage direction_rows(const HeightField& field, const DirectionOptions& options, int first_row,
                          int last_row, const std::function<bool()>& stop) {
  const int least = rays_for_each * static_cast<int>(options.set.directions.size());
  if (options.rays < least)
    fail(ExitCode::usage, "{} rays do not tell {} directions apart; give --rays {} or more", options.rays,
         options.set.directions.size(), least);
  const HeightRays surface(field);
  const std::vector<RaySet> sets = ray_sets(options);
  const FloatImage normals = height_normals(field, first_row, last_row);
  FloatImage weights(field.width(), last_row - first_row, static_cast<int>(options.set.directions.size()));
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, weights.height(), [&](int row) {
      if (stop && stop()) return;
      std::vector<float> response(static_cast<std::size_t>(options.rays));
      for (int x = 0; x < field.width(); ++x) {
        const int y = row + first_row;
        const RaySet& set = sets[ray_set_of(x, y)];
        const auto n = normals.texel(x, row);
        std::ranges::transform(set.directions, response.begin(), [&](const Vec3& direction) {
          const float cosine = direction.dot(Vec3(n[0], n[1], n[2]));
          return cosine > 0 && !surface.occluded(x, y, direction) ? cosine : 0;
        });
        set.weights.solve(response, options.sign, weights.texel(x, row));
      }
    });
  });
  return weights;
}

}  // namespace rnmbake
