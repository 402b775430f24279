#include "trace/probes/surroundings.h"

#include "sampling/maps.h"
#include "sampling/octahedral.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

Surroundings around(const TraceScene& scene, const Vec3& point, const SurroundingsOptions& options) {
  const int grid = std::max(1, static_cast<int>(std::lround(std::sqrt(options.rays_per_texel))));
  const auto texels = static_cast<std::size_t>(options.side) * static_cast<std::size_t>(options.side);
  const float step = 2.0F / static_cast<float>(options.side * grid);
  Surroundings found;
  found.mean.resize(texels, 0);
  found.square.resize(texels, 0);
  std::vector<TransparentHit> passed;
  std::size_t backs = 0;
  for (int row = 0; row < options.side * grid; ++row) {
    for (int column = 0; column < options.side * grid; ++column) {
      const Vec3 direction =
          octahedral_direction({-1 + step * (float(column) + 0.5F), -1 + step * (float(row) + 0.5F)});
      Hit hit;
      passed.clear();
      double distance = options.reach;
      if (scene.intersect({point, direction, infinity}, hit, passed)) {
        distance = std::min(distance, double(hit.distance));
        found.nearest = std::min(found.nearest, double(hit.distance));
        if (hit.normal.dot(direction) > 0) {
          ++backs;
          if (double(hit.distance) < found.way_out_distance) {
            found.way_out_distance = double(hit.distance);
            found.way_out = direction;
          }
        }
      }
      const auto texel = static_cast<std::size_t>(row / grid) * static_cast<std::size_t>(options.side) +
                         static_cast<std::size_t>(column / grid);
      const double share = 1.0 / (grid * grid);
      found.mean[texel] += static_cast<float>(distance * share);
      found.square[texel] += static_cast<float>(distance * distance * share);
    }
  }
  found.back_faces = double(backs) / (double(texels) * grid * grid);
  return found;
}

}  // namespace

std::vector<Surroundings> look_around(const TraceScene& scene, std::span<const Vec3> points,
                                      const SurroundingsOptions& options, const std::function<bool()>& stop) {
  std::vector<Surroundings> found(points.size());
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
      if (stop && stop()) return;
      found[i] = around(scene, points[i], options);
    });
  });
  return found;
}

}  // namespace rnmbake
