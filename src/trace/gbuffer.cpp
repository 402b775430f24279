#include "trace/gbuffer.h"

#include "trace/primary_rays.h"

#include <cstdint>

namespace rnmbake {
namespace {

Vec3d along(const Mat44& to_world, const Vec3d& direction) {
  Vec3d result;
  to_world.multDirMatrix(direction, result);
  return result.normalized();
}

}  // namespace

GBuffer trace_gbuffer(const TraceScene& scene, const Camera& camera, const ViewOptions& options,
                      const SurfaceVector& normal, const std::function<void(double)>& progress,
                      const std::function<bool()>& stop) {
  const int width = options.width, height = options.height;
  const auto image = [&](int channels) { return FloatImage(width, height, channels); };
  GBuffer result{image(3), image(3), image(3), image(1), image(1), image(1)};
  const CameraRays rays(camera, width, height, scene.origin());
  const Vec3d ahead = along(camera.to_world, {0, 0, -1}), eye = camera.to_world.translation();
  const auto pixel = [&](int x, int y) {
    const auto number =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x);
    Sampler sampler(hash_of(options.seed, number), 0);
    const PrimaryHit seen = follow_primary(scene, rays.through(x + 0.5, y + 0.5), sampler);
    if (!seen.met) return;
    const Vec3d position = Vec3d(seen.vertex.position) + scene.origin();
    set_vec3(result.normal, x, y, normal(seen.vertex));
    set_vec3(result.face, x, y, Vec3(seen.vertex.face));
    set_vec3(result.position, x, y, Vec3(position));
    result.depth.texel(x, y)[0] = static_cast<float>((position - eye).dot(ahead));
    result.object.texel(x, y)[0] = static_cast<float>(scene.triangles().object[seen.vertex.triangle] + 1);
    result.coverage.texel(x, y)[0] = 1;
  };
  trace_rows(
      height, options.threads,
      [&](int y) {
        for (int x = 0; x < width; ++x) pixel(x, y);
      },
      progress, stop);
  return result;
}

}  // namespace rnmbake
