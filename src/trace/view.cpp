#include "trace/view.h"

#include "sampling/maps.h"
#include "trace/transparency.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

/// Result of one primary ray.
struct Seen {
  Vec3 radiance{0, 0, 0}, albedo{0, 0, 0};
  float surface = 0;
};

/// Follows a primary ray to the surface where its path stops, past what is not visible to cameras.
Seen see(const TraceScene& scene, Ray ray, const ReflectedLight& reflected, Sampler& sampler) {
  const auto& objects = scene.diffuse_scene().survey.objects;
  const auto is_visible = [&](std::uint32_t triangle) {
    return bool(objects[scene.triangles().object[triangle]].visible_to_camera);
  };
  Seen seen;
  Vec3 weight(1);
  while (true) {
    const auto on_emission = [&](const Hit&, const Vec3& radiance) { seen.radiance += weight * radiance; };
    const PathHit end = trace_through(scene, ray, sampler, on_emission, is_visible);
    weight *= end.weight();
    if (!end.met) {
      seen.radiance += weight * scene.lights().world(ray.direction);
      seen.surface = 1 - (weight.x + weight.y + weight.z) / 3;
      return seen;
    }
    const Vertex vertex = vertex_at(scene, ray, end.hit);
    if (is_visible(end.hit.triangle)) {
      seen.radiance += weight * reflected(vertex, sampler);
      seen.albedo = weight * scene.materials().albedo(vertex.material, vertex.uv);
      seen.surface = 1;
      return seen;
    }
    // A step along the ray as well: at grazing angles the offset through the face advances the ray too
    // little.
    const float step = std::max(vertex.ray_offset, 1e-6F * end.hit.distance);
    ray.origin = vertex.start_below() + ray.direction * step;
  }
}

class ViewTracer {
 public:
  ViewTracer(const TraceScene& scene, const Camera& camera, const ViewOptions& options,
             const ReflectedLight& reflected)
      : scene_(scene),
        options_(options),
        reflected_(reflected),
        rays_(camera, options.width, options.height, scene.origin()),
        view_{FloatImage(options.width, options.height, 3), FloatImage(options.width, options.height, 3),
              FloatImage(options.width, options.height, 1)} {}

  void row(int y) {
    for (int x = 0; x < options_.width; ++x) pixel(x, y);
  }
  View take() { return std::move(view_); }

 private:
  void pixel(int x, int y) {
    const auto number = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(options_.width) +
                        static_cast<std::uint64_t>(x);
    const std::uint64_t seed = hash_of(options_.seed, number);
    Vec3 radiance(0), albedo(0);
    float surfaces = 0;
    for (int s = 0; s < options_.samples; ++s) {
      Sampler sampler(seed, static_cast<std::uint32_t>(s));
      const Vec2 in_pixel = sampler.next2();
      const Seen seen =
          see(scene_, rays_.through(x + double(in_pixel.x), y + double(in_pixel.y)), reflected_, sampler);
      radiance += seen.radiance;
      albedo += seen.albedo;
      surfaces += seen.surface;
    }
    const float scale = 1 / static_cast<float>(options_.samples);
    for (int c = 0; c < 3; ++c) {
      view_.beauty.texel(x, y)[c] = radiance[c] * scale;
      view_.albedo.texel(x, y)[c] = albedo[c] * scale;
    }
    view_.coverage.texel(x, y)[0] = surfaces * scale;
  }

  const TraceScene& scene_;
  const ViewOptions& options_;
  const ReflectedLight& reflected_;
  CameraRays rays_;
  View view_;
};

}  // namespace

double pixel_shape(const Camera& camera) {
  if (camera.orthographic) return 1;  // its height is not known
  const double wide = std::tan(camera.angle_x / 2) / camera.resolution_x;
  const double high = std::tan(camera.angle_y / 2) / camera.resolution_y;
  return wide > 0 && high > 0 ? wide / high : 1;
}

CameraRays::CameraRays(const Camera& camera, int width, int height, const Vec3d& origin)
    : to_world_(camera.to_world),
      origin_(origin),
      orthographic_(camera.orthographic),
      pixels_x_(width),
      pixels_y_(height),
      width_(camera.orthographic ? camera.width : 2 * std::tan(camera.angle_x / 2)),
      height_(width_ * height / width / pixel_shape(camera)),
      shift_x_(camera.shift_x * width_),
      shift_y_(camera.shift_y * width_) {}

Ray CameraRays::through(double x, double y) const {
  const double right = (x / pixels_x_ - 0.5) * width_ + shift_x_;
  const double up = (0.5 - y / pixels_y_) * height_ + shift_y_;
  Vec3d origin(0, 0, 0), direction(0, 0, -1);
  (orthographic_ ? origin : direction) += Vec3d(right, up, 0);
  Vec3d world_origin, world_direction;
  to_world_.multVecMatrix(origin, world_origin);
  to_world_.multDirMatrix(direction, world_direction);
  return {Vec3(world_origin - origin_), unit(Vec3(world_direction.normalized())), infinity};
}

View trace_view(const TraceScene& scene, const Camera& camera, const ViewOptions& options,
                const ReflectedLight& reflected, const std::function<void(double)>& progress,
                const std::function<bool()>& stop) {
  ViewTracer tracer(scene, camera, options, reflected);
  std::mutex mutex;
  int done = 0;
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(0, options.height, [&](int y) {
      if (stop && stop()) return;
      tracer.row(y);
      const std::lock_guard lock(mutex);
      ++done;
      if (progress) progress(double(done) / options.height);
    });
  });
  return tracer.take();
}

}  // namespace rnmbake
