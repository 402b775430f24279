#include "trace/path.h"

#include "trace/lobes.h"

#include <algorithm>
#include <limits>

namespace rnmbake {
namespace {

constexpr float inv_pi = static_cast<float>(1 / pi);
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr int first_roulette =
    4;  // bounces before Russian roulette: earlier it costs more noise than it saves

float largest(const Vec3& c) {
  return std::max({c.x, c.y, c.z});
}

/// Irradiance/pi at a vertex from one light that was chosen by chance.
Vec3 sampled_light(const TraceScene& scene, const Vertex& vertex, const PathOptions& options,
                   Sampler& sampler, std::int64_t& rays) {
  const LightSample light = scene.lights().sample(vertex.start(), vertex.normal, sampler.next3());
  const float cosine = vertex.normal.dot(light.direction);
  // Not from under the face, where chance would not find it either.
  if (!(light.pdf > 0) || !(cosine > 0) || !(vertex.face.dot(light.direction) > 0)) return Vec3(0);
  ++rays;
  if (scene.occluded({vertex.start(), light.direction, short_of(light.distance, vertex.gap)})) {
    return Vec3(0);
  }
  const float share = light.chance_hits && options.chance_hits ? balance(light.pdf, cosine * inv_pi) : 1;
  return light.radiance * (cosine * inv_pi * share / light.pdf);
}

/// Weight of light that a ray with pdf cos/pi met by chance.
float chance_share(const PathOptions& options, float pdf, float light_pdf) {
  if (!options.chance_hits) return 0;
  return options.light_sampling ? balance(pdf, light_pdf) : 1;
}

}  // namespace

Vec3 reflected_radiance(const TraceScene& scene, Vertex vertex, const PathOptions& options, Sampler& sampler,
                        std::int64_t& rays) {
  const Lights& lights = scene.lights();
  Vec3 sum(0), throughput(1);
  for (int bounce = 0; options.bounces < 0 || bounce < options.bounces; ++bounce) {
    throughput *= scene.looks().albedo(vertex.look, vertex.uv);
    const float survival = bounce < first_roulette ? 1 : std::min(0.98F, largest(throughput));
    if (!(largest(throughput) > 0)) break;
    if (options.light_sampling) sum += throughput * sampled_light(scene, vertex, options, sampler, rays);

    if (survival < 1) {
      if (!(sampler.next1() < survival)) break;
      throughput /= survival;
    }
    const Vec3 direction = cosine_direction(vertex.normal, sampler.next2());
    if (!(direction.dot(vertex.face) > 0)) break;  // under the face
    const float pdf = direction.dot(vertex.normal) * inv_pi;
    const Ray ray{vertex.start(), direction, infinity};
    Hit hit;
    ++rays;
    if (!scene.intersect(ray, hit)) {
      const float other = lights.world_pdf(ray.origin, vertex.normal, direction);
      sum += throughput * lights.world(direction) * chance_share(options, pdf, other);
      break;
    }
    const Vertex next = vertex_at(scene, ray, hit);
    if (scene.looks().emits(next.look)) {
      const float other =
          lights.triangle_pdf(ray.origin, vertex.normal, hit.triangle, direction, hit.distance);
      sum += throughput * scene.looks().emission(next.look, next.uv) * chance_share(options, pdf, other);
    }
    vertex = next;
  }
  return sum;
}

}  // namespace rnmbake
