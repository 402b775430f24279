#include "trace/path.h"

#include "base/math.h"
#include "sampling/maps.h"
#include "sampling/orthonormal_basis.h"
#include "trace/transparency.h"

#include <algorithm>

namespace rnmbake {
namespace {

// Bounces before Russian roulette. Early: only the first vertex of a path is shared by a block.
constexpr int first_roulette = 1;

/// The closure at a vertex: a diffuse one, or what the recipe makes of it.
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

/// Next-event estimation at a vertex: irradiance / pi from one sampled light. `bounces`: of the path so far.
Vec3 sampled_light(const TraceScene& scene, const Vertex& vertex, const Reflector& reflector,
                   const PathOptions& options, int bounces, Sampler& sampler, std::int64_t& rays) {
  const LightSample light = scene.lights().sample(vertex.start(), reflector.closure.normal, sampler.next3());
  const float cosine = reflector.cosine(light.direction);
  // Light from below the face is left out, since BSDF sampling never finds it.
  const bool above = vertex.face.dot(light.direction) > 0;
  const bool counts = above || (reflector.sees_below_face() && sampled_below(scene.lights(), light));
  if (!(light.pdf > 0) || !(cosine > 0) || !counts || bounces > light.max_bounces) return Vec3(0);
  if (!options.sampled.takes(light)) return Vec3(0);
  ++rays;
  const Vec3 start = above ? vertex.start() : options.own->start_below(vertex, light.direction);
  const Visibility visibility =
      scene.visibility({start, light.direction, shadow_tmax(light.distance, vertex.ray_offset)});
  if (visibility.blocked()) return Vec3(0);
  const float bsdf_pdf = cosine_hemisphere_pdf(reflector.closure.normal.dot(light.direction));
  float mis = 1;
  if (light.bsdf_can_hit && options.sample_bsdf) {
    mis = above ? balance_heuristic(light.pdf, bsdf_pdf) : power_heuristic(light.pdf, bsdf_pdf);
  }
  return light.radiance * (cosine * inv_pi * mis / light.pdf) * visibility.transmittance;
}

}  // namespace

Vec3 reflected_radiance(const TraceScene& scene, Vertex vertex, const PathOptions& options, Sampler& sampler,
                        std::int64_t& rays) {
  const Lights& lights = scene.lights();
  Vec3 sum(0), throughput(1);
  for (int bounce = 0; options.bounces < 0 || bounce < options.bounces; ++bounce) {
    throughput *= scene.materials().albedo(vertex.material, vertex.uv);
    const float survival = bounce < first_roulette ? 1 : std::min(0.98F, max_channel(throughput));
    if (!(max_channel(throughput) > 0)) break;
    const Reflector reflector(vertex, options);
    const Vec3& normal = reflector.closure.normal;
    if (options.sample_lights) {
      const int before = options.before + bounce;
      sum += throughput * sampled_light(scene, vertex, reflector, options, before, sampler, rays);
    }
    if (survival < 1) {
      if (!(sampler.next1() < survival)) break;
      throughput /= survival;
    }
    const Vec3 direction = unit(OrthonormalBasis(normal).to_world(cosine_hemisphere_polar(sampler.next2())));
    if (!(direction.dot(vertex.face) > 0)) break;  // below the face
    const float pdf = cosine_hemisphere_pdf(direction.dot(normal));
    if (reflector.recipe != nullptr) throughput *= reflector.cosine(direction) * inv_pi / pdf;
    const auto bsdf_weight = [&](float light_pdf) {
      return mis_weight(options.sample_lights, options.sample_bsdf, pdf, light_pdf);
    };
    const Ray ray{vertex.start(), direction, infinity};
    ++rays;
    const PathHit next = trace_through(scene, ray, sampler, [&](const Hit& hit, const Vec3& radiance) {
      const float light_pdf = lights.triangle_pdf(ray.origin, normal, hit.triangle, direction, hit.distance);
      sum += throughput * radiance * bsdf_weight(light_pdf);
    });
    throughput *= next.weight();
    if (!next.met) {
      const float light_pdf = lights.world_pdf(ray.origin, normal, direction);
      sum += throughput * lights.world(direction) * bsdf_weight(light_pdf);
      break;
    }
    vertex = vertex_at(scene, ray, next.hit);
  }
  return sum;
}

}  // namespace rnmbake
