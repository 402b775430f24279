#include "trace/block.h"

#include "encoding/rnm.h"
#include "encoding/sh.h"
#include "sampling/maps.h"
#include "trace/transparency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rnmbake {

BlockGatherer::BlockGatherer(const TraceScene& scene, const PointSource& points, const GatherOptions& options,
                             const OwnSurface* own, const Incident* incident)
    : scene_(scene),
      points_(points),
      options_(options),
      own_(own),
      incident_(incident),
      path_{options.bounces, 1, options.sample_lights, options.sample_bsdf, {}, nullptr, nullptr, Vec3(0)},
      directions_(options.directions.size()),
      coefficients_(static_cast<std::size_t>(options.sh_order) * options.sh_order),
      framed_(coefficients_ > 0 || options.faults.any() || !few_directions()),
      states_(most_points + lamp_samples),
      lobes_(most_points + lamp_samples),
      normals_((most_points + lamp_samples) * options.directions.size()),
      shared_vertices_(most_points),
      back_faces_(most_points) {
  if (!options.faults.any()) return;
  recipe_.emplace(options.faults, options.blender_version);
  if (!options.faults.self_reflection) return;
  path_.own = own;
  path_.recipe = &*recipe_;
  path_.basis = options.directions.front().direction;
}

void BlockGatherer::batch(std::size_t first, std::size_t count, int samples, std::uint64_t seed,
                          BatchStatistics& statistics) {
  const bool lamps = options_.sample_lights && !scene_.lights().empty();
  for (std::size_t i = 0; i < count; ++i) states_[i].sums = statistics.texel(i);
  for (int s = 0; s < samples; ++s) {
    for (std::size_t i = 0; i < count; ++i) {
      Sampler sampler(hash_of(seed, 2 * i), static_cast<std::uint32_t>(s));
      start_sample(i, first + i, sampler);
      set_lobes(i);
      trace_path(i, sampler);
      if (lamps) sample_lamps(i, first + i, hash_of(seed, 2 * i + 1), s);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (shared_vertices_[i].radiance != Vec3(0)) share(i, count);
    }
  }
  if (recipe_ && options_.faults.no_diffuse) {
    for (std::size_t i = 0; i < count; ++i) apply_no_diffuse(i, first + i);
  }
  statistics.end_batch(samples);
}

/// Turns the sums into what Cycles bakes without colour, by the mean albedo over the footprint.
void BlockGatherer::apply_no_diffuse(std::size_t i, std::size_t index) {
  constexpr std::uint32_t points = 16;
  Vec3 albedo(0);
  for (std::uint32_t k = 0; k < points; ++k) {
    Sampler sampler(0, k);
    const GatherPoint point = points_.sample(index, sampler.next2());
    albedo += own_->albedo(point.triangle, point.barycentric);
  }
  for (std::size_t k = 0; k < directions_; ++k)
    states_[i].sums[k] = without_color(states_[i].sums[k], albedo);
}

/// Samples a point of the footprint, and the directions' normals there.
void BlockGatherer::start_sample(std::size_t i, std::size_t index, Sampler& sampler) {
  const GatherPoint point = points_.sample(index, sampler.next2());
  PointState& it = states_[i];
  it.point = point;
  it.ray_offset = ray_offset_at(point.position);
  it.origin = point.position + point.face * it.ray_offset;
  if (framed_) {
    const Vec3 normal = point.frame.normal.normalized(), along = point.frame.tangent;
    const Vec3 tangent = (along - normal * along.dot(normal)).normalized();
    it.point.frame = {tangent, normal.cross(tangent) * point.frame.sign, normal, point.frame.sign};
  }
  Vec3* normals = &normals_[i * directions_];
  for (std::size_t k = 0; k < directions_; ++k) {
    normals[k] = unit(point.frame.to_world(options_.directions[k].direction));
    if (recipe_)
      normals[k] =
          recipe_->closure(normals[k], it.point.frame.normal, point.face, it.point.frame.normal).normal;
  }
}

/// Prepares the density of primary rays.
void BlockGatherer::set_lobes(std::size_t i) {
  const GatherPoint& point = states_[i].point;
  const Vec3* normals = &normals_[i * directions_];
  const bool few = few_directions();
  CosineLobes lobes(point.face, coefficients_ > 0 || !few);
  if (few) {
    for (std::size_t k = 0; k < directions_; ++k) lobes.add(normals[k]);
  } else {
    lobes.add(point.frame.normal);
    for (const Vec3& b : rnm_basis()) lobes.add(unit(point.frame.to_world(b)));
  }
  lobes_[i] = lobes;
}

/// Adds light from a direction to all estimates. `light`: radiance over pdf.
void BlockGatherer::add(std::size_t i, const Vec3& direction, const Vec3& light) {
  const PointState& it = states_[i];
  const Vec3* normals = &normals_[i * directions_];
  const Vec3 over_pi = light * inv_pi;
  for (std::size_t k = 0; k < directions_; ++k) {
    const float cosine = recipe_ ? recipe_->cosine({normals[k], it.point.frame.normal, true}, direction)
                                 : std::max(0.0F, direction.dot(normals[k]));
    it.sums[k] += over_pi * cosine;
  }
  if (coefficients_ == 0) return;
  const auto y = sh_basis(it.point.frame.to_tangent(direction));
  for (std::size_t c = 0; c < coefficients_; ++c) it.sums[directions_ + c] += light * y[c];
}

/// Next-event estimation: from several points of the footprint, one light each.
void BlockGatherer::sample_lamps(std::size_t i, std::size_t index, std::uint64_t seed, int sample) {
  std::array<Ray, lamp_samples> rays;
  std::array<LightSample, lamp_samples> lights;
  std::array<std::size_t, lamp_samples> from{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < lamp_samples; ++k) {
    Sampler sampler(seed, static_cast<std::uint32_t>(std::size_t(sample) * lamp_samples + k));
    const std::size_t slot = most_points + k;
    PointState& it = states_[slot];
    it.sums = states_[i].sums;
    start_sample(slot, index, sampler);
    const LightSample light = scene_.lights().sample(it.origin, horizon(slot), sampler.next3());
    if (!(light.pdf > 0) || !options_.direct.takes(light)) continue;
    if (!(light.direction.dot(it.point.face) > grazing_sine)) {
      if (recipe_ && recipe_->faults().below_horizon) add_below(slot, light);
      continue;
    }
    rays[count] = {it.origin, light.direction, shadow_tmax(light.distance, it.ray_offset)};
    lights[count] = light;
    from[count++] = slot;
  }
  if (count == 0) return;
  rays_ += static_cast<std::int64_t>(count);
  std::array<Visibility, lamp_samples> visibilities;
  scene_.visibility(std::span(rays.data(), count), visibilities.data());
  for (std::size_t k = 0; k < count; ++k) {
    if (visibilities[k].blocked()) continue;
    const LightSample& light = lights[k];
    const float pdf = light.pdf * lamp_samples;
    float mis = 1;
    if (light.bsdf_can_hit && options_.sample_bsdf) {
      set_lobes(from[k]);
      mis = balance_heuristic(pdf, lobes_[from[k]].pdf(light.direction));
    }
    add(from[k], light.direction, light.radiance * (mis / pdf) * visibilities[k].transmittance);
  }
}

/// Adds a light below the face: Cycles asks only whether it is above the horizon of the closure.
void BlockGatherer::add_below(std::size_t i, const LightSample& light) {
  if (!sampled_below(scene_.lights(), light)) return;
  const PointState& it = states_[i];
  const Vec3 start = own_->start_below(it.point.triangle, it.point.barycentric, it.origin, light.direction);
  ++rays_;
  const Visibility visibility =
      scene_.visibility({start, light.direction, shadow_tmax(light.distance, 2 * it.ray_offset)});
  if (visibility.blocked()) return;
  for (std::size_t k = 0; k < directions_; ++k) {
    const Vec3& normal = normals_[i * directions_ + k];
    const float bsdf_pdf = cosine_hemisphere_pdf(normal.dot(light.direction));
    if (!(bsdf_pdf > 0)) continue;
    const float mis = light.bsdf_can_hit ? power_heuristic(light.pdf, bsdf_pdf) : 1;
    const float cosine = recipe_->cosine({normal, it.point.frame.normal, true}, light.direction);
    it.sums[k] +=
        light.radiance * (cosine * inv_pi * mis / (light.pdf * lamp_samples)) * visibility.transmittance;
  }
}

/// Traces the primary ray and the path behind it. Emission and sky are added at once, reflected radiance is
/// left in `shared_vertices_`.
void BlockGatherer::trace_path(std::size_t i, Sampler& sampler) {
  const Vec3 origin = states_[i].origin;
  SharedVertex& shared = shared_vertices_[i];
  shared.radiance = Vec3(0);
  const float choice = sampler.next1();
  const Vec3 direction = lobes_[i].sample(choice, sampler.next2());
  const float pdf = lobes_[i].pdf(direction);
  if (incident_ != nullptr) return follow_elsewhere(i, direction, pdf);
  if (!(pdf > 0)) return;
  const auto bsdf_weight = [&](float light_pdf) {
    return mis_weight(options_.sample_lights, options_.sample_bsdf, pdf, light_pdf * lamp_samples);
  };
  const Ray ray{origin, direction, infinity};
  ++rays_;
  const PathHit end = trace_through(scene_, ray, sampler, [&](const Hit& hit, const Vec3& radiance) {
    if (!options_.direct.glow) return;
    const float light_pdf =
        scene_.lights().triangle_pdf(origin, horizon(i), hit.triangle, direction, hit.distance);
    add(i, direction, radiance * (bsdf_weight(light_pdf) / pdf));
  });
  if (!end.met) {
    if (!options_.direct.glow) return;
    const float light_pdf = scene_.lights().world_pdf(origin, horizon(i), direction);
    add(i, direction, scene_.lights().world(direction) * (bsdf_weight(light_pdf) / pdf) * end.weight());
    return;
  }
  const Vertex vertex = vertex_at(scene_, ray, end.hit);
  if (vertex.back && !scene_.materials().see_through(vertex.material))
    ++back_faces_[i];  // leaves have two sides
  const Vec3 radiance = reflected_radiance(scene_, vertex, path_, sampler, rays_);
  if (radiance == Vec3(0)) return;
  if (!options_.reuse) {
    add(i, direction, radiance / pdf * end.weight());
    return;
  }
  shared = {vertex.position, vertex.face, vertex.start(), radiance / end.stop_probability, end.visibility};
}

/// Asks for the radiance along a primary ray, or takes it in. Where it comes from a surface that sends the
/// same to all sides it is left in `shared_vertices_`; see-through surfaces send what lies behind them, too,
/// and end segments as all others do.
void BlockGatherer::follow_elsewhere(std::size_t i, const Vec3& direction, float pdf) {
  const Ray ray{states_[i].origin, direction, infinity};
  if (incident_->asked != nullptr)
    return incident_->asked->push_back({ray.origin, direction, states_[i].point.face});
  const Vec3 radiance = incident_->radiance[next_incident_++];
  if (!(pdf > 0) || radiance == Vec3(0)) return;
  ++lit_;
  ++rays_;
  Hit hit;
  std::vector<TransparentHit> none;  // all of this scene's materials are opaque
  if (!scene_.intersect(ray, hit, none)) return add(i, direction, radiance / pdf);
  const Vertex vertex = vertex_at(scene_, ray, hit);
  if (incident_->even[vertex.material] == 0) return add(i, direction, radiance / pdf);
  ++shared_;
  shared_vertices_[i] = {vertex.position, vertex.face, vertex.start(), radiance, Visibility{}};
}

/// Adds the vertex that point `finder` found to every point that sees it.
void BlockGatherer::share(std::size_t finder, std::size_t count) {
  const SharedVertex& vertex = shared_vertices_[finder];
  std::array<Ray, most_points> rays;
  std::array<std::size_t, most_points> who{};  // on the right side of both faces
  std::size_t candidates = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& origin = states_[i].origin;
    const Vec3 to_vertex = vertex.position - origin;
    const bool faces = to_vertex.dot(vertex.face) < 0 && to_vertex.dot(states_[i].point.face) > 0;
    if (!faces || i == finder) continue;
    const Vec3 segment = vertex.target - origin;
    const float length = segment.length();
    rays[candidates] = {origin, segment / length, length};
    who[candidates++] = i;
  }
  rays_ += static_cast<std::int64_t>(candidates);
  std::array<Visibility, most_points> visibilities;
  std::size_t seeing = 0;
  for (std::size_t first = 0; first < candidates; first += TraceScene::packet) {
    const std::size_t size = std::min(TraceScene::packet, candidates - first);
    std::array<Visibility, TraceScene::packet> of_packet;
    scene_.visibility(std::span(&rays[first], size), of_packet.data());
    for (std::size_t k = 0; k < size; ++k) {
      if (of_packet[k].blocked()) continue;
      visibilities[seeing] = of_packet[k];
      who[seeing++] = who[first + k];
    }
  }
  visibilities[seeing] = vertex.visibility;
  who[seeing++] = finder;

  std::array<Vec3, most_points> directions;
  std::array<float, most_points> geometry{};  // solid angle per area at the vertex
  float density = 0;                          // of finding the vertex, per area
  for (std::size_t k = 0; k < seeing; ++k) {
    const Vec3 to_vertex = vertex.position - states_[who[k]].origin;
    const float distance2 = to_vertex.dot(to_vertex), distance = std::sqrt(distance2);
    directions[k] = to_vertex / distance;
    // Rounding can put a vertex that is all but touched below the face, where nothing bounds its weight.
    const float pdf = lobes_[who[k]].pdf(directions[k]);
    if (pdf > 0) geometry[k] = std::max(0.0F, -to_vertex.dot(vertex.face)) / (distance * distance2);
    density += pdf * geometry[k] * visibilities[k].transmit_probability;
  }
  if (!(density > 0) || !std::isfinite(density)) return;
  for (std::size_t k = 0; k < seeing; ++k) {
    add(who[k], directions[k], vertex.radiance * (geometry[k] / density) * visibilities[k].transmittance);
  }
}

}  // namespace rnmbake
