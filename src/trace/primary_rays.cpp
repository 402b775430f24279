#include "trace/primary_rays.h"

#include "trace/transparency.h"

#include <algorithm>
#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {

PrimaryHit follow_primary(const TraceScene& scene, Ray ray, Sampler& sampler) {
  const auto& objects = scene.diffuse_scene().survey.objects;
  const auto is_visible = [&](std::uint32_t triangle) {
    return bool(objects[scene.triangles().object[triangle]].visible_to_camera);
  };
  PrimaryHit result;
  while (true) {
    const auto on_emission = [&](const Hit&, const Vec3& radiance) {
      result.emitted += result.weight * radiance;
    };
    const PathHit end = trace_through(scene, ray, sampler, on_emission, is_visible);
    result.weight *= end.weight();
    if (!end.met) return result;
    result.vertex = vertex_at(scene, ray, end.hit);
    result.met = is_visible(end.hit.triangle);
    if (result.met) return result;
    // A step along the ray as well: at grazing angles the offset through the face advances the ray too
    // little.
    const float step = std::max(result.vertex.ray_offset, 1e-6F * end.hit.distance);
    ray.origin = result.vertex.start_below() + ray.direction * step;
  }
}

void trace_rows(int height, int threads, const std::function<void(int)>& row,
                const std::function<void(double)>& progress, const std::function<bool()>& stop) {
  std::mutex mutex;
  int done = 0;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, height, [&](int y) {
      if (stop && stop()) return;
      row(y);
      const std::lock_guard lock(mutex);
      ++done;
      if (progress) progress(double(done) / height);
    });
  });
}

}  // namespace rnmbake
