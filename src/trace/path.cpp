#include "trace/path.h"

#include "sampling/maps.h"
#include "sampling/orthonormal_basis.h"
#include "trace/transparency.h"

#include <algorithm>

namespace rnmbake {
namespace {

// Bounces before Russian roulette. Where texels share what a path's end is worth, long paths are dear.
constexpr int first_roulette = 1;

float largest(const Vec3& c) {
  return std::max({c.x, c.y, c.z});
}

/// What reflects at a vertex, and how much of what comes from a direction.
struct Reflector {
  Closure closure;
  const Recipe* recipe = nullptr;  // null: an ideal diffuse surface

  Reflector(const Vertex& vertex, const PathOptions& options) : closure{vertex.normal, vertex.normal} {
    if (options.own == nullptr || !options.own->holds(vertex)) return;
    recipe = options.recipe;
    closure =
        recipe->closure(options.own->direction(vertex, options.basis), vertex.normal, vertex.face, vertex.wo);
  }
  [[nodiscard]] float cosine(const Vec3& direction) const {
    return recipe == nullptr ? closure.normal.dot(direction) : recipe->cosine(closure, direction);
  }
  [[nodiscard]] bool sees_below_face() const { return recipe != nullptr && recipe->faults().below_horizon; }
};

/// Irradiance/pi at a vertex from one light that was chosen by chance, for a path of so many bounces before.
Vec3 sampled_light(const TraceScene& scene, const Vertex& vertex, const Reflector& reflector,
                   const PathOptions& options, int bounces, Sampler& sampler, std::int64_t& rays) {
  const LightSample light = scene.lights().sample(vertex.start(), reflector.closure.normal, sampler.next3());
  const float cosine = reflector.cosine(light.direction);
  // Not from under the face, where chance would not find it either.
  const bool above = vertex.face.dot(light.direction) > 0;
  const bool counts = above || (reflector.sees_below_face() && sampled_below(scene.lights(), light));
  if (!(light.pdf > 0) || !(cosine > 0) || !counts || bounces > light.max_bounces) return Vec3(0);
  ++rays;
  const Vec3 start = above ? vertex.start() : options.own->start_below(vertex, light.direction);
  const Visibility left =
      scene.visibility({start, light.direction, shadow_tmax(light.distance, vertex.ray_offset)});
  if (left.blocked()) return Vec3(0);
  const float other = reflector.closure.normal.dot(light.direction) * inv_pi;
  float share = 1;
  if (light.sample_bsdf && options.sample_bsdf) {
    share = above ? balance_heuristic(light.pdf, other) : power_heuristic(light.pdf, other);
  }
  return light.radiance * (cosine * inv_pi * share / light.pdf) * left.transmittance;
}

}  // namespace

Vec3 reflected_radiance(const TraceScene& scene, Vertex vertex, const PathOptions& options, Sampler& sampler,
                        std::int64_t& rays) {
  const Lights& lights = scene.lights();
  Vec3 sum(0), throughput(1);
  for (int bounce = 0; options.bounces < 0 || bounce < options.bounces; ++bounce) {
    throughput *= scene.materials().albedo(vertex.material, vertex.uv);
    const float survival = bounce < first_roulette ? 1 : std::min(0.98F, largest(throughput));
    if (!(largest(throughput) > 0)) break;
    const Reflector reflector(vertex, options);
    const Vec3& normal = reflector.closure.normal;
    if (options.light_sampling) {
      const int before = options.before + bounce;
      sum += throughput * sampled_light(scene, vertex, reflector, options, before, sampler, rays);
    }
    if (survival < 1) {
      if (!(sampler.next1() < survival)) break;
      throughput /= survival;
    }
    const Vec3 direction = unit(OrthonormalBasis(normal).to_world(cosine_hemisphere_polar(sampler.next2())));
    if (!(direction.dot(vertex.face) > 0)) break;  // under the face
    const float pdf = direction.dot(normal) * inv_pi;
    if (reflector.recipe != nullptr) throughput *= reflector.cosine(direction) * inv_pi / pdf;
    const auto by_bsdf = [&](float light_pdf) {
      return mis_weight(options.light_sampling, options.sample_bsdf, pdf, light_pdf);
    };
    const Ray ray{vertex.start(), direction, infinity};
    ++rays;
    const PathHit next = trace_through(scene, ray, sampler, [&](const Hit& hit, const Vec3& radiance) {
      const float other = lights.triangle_pdf(ray.origin, normal, hit.triangle, direction, hit.distance);
      sum += throughput * radiance * by_bsdf(other);
    });
    throughput *= next.weight();
    if (!next.met) {
      const float other = lights.world_pdf(ray.origin, normal, direction);
      sum += throughput * lights.world(direction) * by_bsdf(other);
      break;
    }
    vertex = vertex_at(scene, ray, next.hit);
  }
  return sum;
}

}  // namespace rnmbake
