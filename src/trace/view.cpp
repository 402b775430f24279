#include "trace/view.h"

#include "sampling/maps.h"
#include "trace/primary_rays.h"

#include <cmath>
#include <utility>

namespace rnmbake {
namespace {

/// Result of one primary ray.
struct Seen {
  Vec3 radiance{0, 0, 0}, albedo{0, 0, 0};
  float surface = 0;
};

Seen see(const TraceScene& scene, const Ray& ray, const ReflectedLight& reflected, Sampler& sampler) {
  const PrimaryHit end = follow_primary(scene, ray, sampler);
  if (!end.met) {
    const float behind = (end.weight.x + end.weight.y + end.weight.z) / 3;
    return {end.emitted + end.weight * scene.lights().world(ray.direction), Vec3(0), 1 - behind};
  }
  const Vertex& vertex = end.vertex;
  return {end.emitted + end.weight * reflected(vertex, sampler),
          end.weight * scene.materials().albedo(vertex.material, vertex.uv), 1};
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
  trace_rows(
      options.height, options.threads, [&](int y) { tracer.row(y); }, progress, stop);
  return tracer.take();
}

}  // namespace rnmbake
