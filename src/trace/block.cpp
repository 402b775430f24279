#include "trace/block.h"

#include "encoding/rnm.h"
#include "encoding/sh.h"
#include "trace/transparency.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {
BlockGatherer::BlockGatherer(const TraceScene& scene, const TexelSamples& texel_samples,
                             const GatherOptions& options, const OwnSurface* own)
    : scene_(scene),
      texel_samples_(texel_samples),
      options_(options),
      own_(own),
      path_{options.bounces, 1, options.light_sampling, options.sample_bsdf, nullptr, nullptr, Vec3(0)},
      directions_(options.directions.size()),
      coefficients_(static_cast<std::size_t>(options.sh_order) * options.sh_order),
      framed_(coefficients_ > 0 || options.faults.any() || !few_directions()),
      states_(texels + lamp_samples),
      lobes_(texels + lamp_samples),
      normals_((texels + lamp_samples) * options.directions.size()),
      shared_vertices_(texels),
      back_faces_(texels) {
  if (!options.faults.any()) return;
  recipe_.emplace(options.faults, options.blender_version);
  if (!options.faults.self_reflection) return;
  path_.own = own;
  path_.recipe = &*recipe_;
  path_.basis = options.directions.front().direction;
}

void BlockGatherer::batch(std::span<const TexelSample> block, int samples, std::uint64_t seed,
                          BatchStatistics& statistics) {
  const bool lamps = options_.light_sampling && !scene_.lights().empty();
  for (std::size_t i = 0; i < block.size(); ++i) states_[i].sums = statistics.texel(i);
  for (int s = 0; s < samples; ++s) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      Sampler sampler(hash_of(seed, 2 * i), static_cast<std::uint32_t>(s));
      begin_path(i, block[i], sampler);
      look_around(i);
      trace_path(i, sampler);
      if (lamps) sample_lamps(i, block[i], hash_of(seed, 2 * i + 1), s);
    }
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (shared_vertices_[i].radiance != Vec3(0)) share(i, block.size());
    }
  }
  if (recipe_ && options_.faults.no_diffuse) {
    for (std::size_t i = 0; i < block.size(); ++i) take_color_out(i, block[i]);
  }
  statistics.end_batch(samples);
}

/// By the albedo that the texel has over its footprint.
void BlockGatherer::take_color_out(std::size_t i, const TexelSample& texel) {
  constexpr std::uint32_t places = 16;
  Vec3 albedo(0);
  for (std::uint32_t k = 0; k < places; ++k) {
    Sampler sampler(0, k);
    albedo += own_->albedo(texel.triangle, texel_samples_.place(texel, sampler.next2()).weights);
  }
  for (std::size_t k = 0; k < directions_; ++k)
    states_[i].sums[k] = without_color(states_[i].sums[k], albedo);
}

/// Chooses the place in the texel.
void BlockGatherer::begin_path(std::size_t i, const TexelSample& texel, Sampler& sampler) {
  const Place place = texel_samples_.place(texel, sampler.next2());
  PathState& here = states_[i];
  here.weights = place.weights;
  here.face = place.face;
  here.ray_offset = ray_offset_at(place.position);
  here.position = place.position + place.face * here.ray_offset;
  if (framed_) {
    const Vec3 normal = place.frame.normal.normalized(), along = place.frame.tangent;
    const Vec3 tangent = (along - normal * along.dot(normal)).normalized();
    here.frame = {tangent, normal.cross(tangent) * place.frame.sign, normal, place.frame.sign};
  }
  Vec3* normals = &normals_[i * directions_];
  for (std::size_t k = 0; k < directions_; ++k) {
    normals[k] = unit(place.frame.to_world(options_.directions[k].direction));
    if (recipe_)
      normals[k] = recipe_->closure(normals[k], here.frame.normal, here.face, here.frame.normal).normal;
  }
}

/// Prepares the choice of directions from there.
void BlockGatherer::look_around(std::size_t i) {
  const PathState& here = states_[i];
  const Vec3* normals = &normals_[i * directions_];
  const bool few = few_directions();
  CosineLobes lobes(here.face, coefficients_ > 0 || !few);
  if (few) {
    for (std::size_t k = 0; k < directions_; ++k) lobes.add(normals[k]);
  } else {
    lobes.add(here.frame.normal);
    for (const Vec3& b : rnm_basis()) lobes.add(unit(here.frame.to_world(b)));
  }
  lobes_[i] = lobes;
}

/// `light`: radiance over pdf.
void BlockGatherer::add(std::size_t i, const Vec3& direction, const Vec3& light) {
  const PathState& here = states_[i];
  const Vec3* normals = &normals_[i * directions_];
  const Vec3 over_pi = light * inv_pi;
  for (std::size_t k = 0; k < directions_; ++k) {
    const float cosine = recipe_ ? recipe_->cosine({normals[k], here.frame.normal, true}, direction)
                                 : std::max(0.0F, direction.dot(normals[k]));
    here.sums[k] += over_pi * cosine;
  }
  if (coefficients_ == 0) return;
  const auto y = sh_basis(here.frame.to_tangent(direction));
  for (std::size_t c = 0; c < coefficients_; ++c) here.sums[directions_ + c] += light * y[c];
}

/// From several places in the texel, each at one lamp.
void BlockGatherer::sample_lamps(std::size_t i, const TexelSample& texel, std::uint64_t seed, int sample) {
  std::array<Ray, lamp_samples> rays;
  std::array<LightSample, lamp_samples> lights;
  std::array<std::size_t, lamp_samples> from{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < lamp_samples; ++k) {
    Sampler sampler(seed, static_cast<std::uint32_t>(std::size_t(sample) * lamp_samples + k));
    const std::size_t slot = texels + k;
    PathState& here = states_[slot];
    here.sums = states_[i].sums;
    begin_path(slot, texel, sampler);
    const LightSample light = scene_.lights().sample(here.position, horizon(slot), sampler.next3());
    if (!(light.pdf > 0)) continue;
    if (!(light.direction.dot(here.face) > grazing_sine)) {
      if (recipe_ && recipe_->faults().below_horizon) add_below(slot, texel, light);
      continue;
    }
    rays[count] = {here.position, light.direction, shadow_tmax(light.distance, here.ray_offset)};
    lights[count] = light;
    from[count++] = slot;
  }
  if (count == 0) return;
  rays_ += static_cast<std::int64_t>(count);
  std::array<Visibility, lamp_samples> left;
  scene_.visibility(std::span(rays.data(), count), left.data());
  for (std::size_t k = 0; k < count; ++k) {
    if (left[k].blocked()) continue;
    const LightSample& light = lights[k];
    const float density = light.pdf * lamp_samples;
    float share = 1;
    if (light.sample_bsdf && options_.sample_bsdf) {
      look_around(from[k]);
      share = balance_heuristic(density, lobes_[from[k]].pdf(light.direction));
    }
    add(from[k], light.direction, light.radiance * (share / density) * left[k].transmittance);
  }
}

/// A lamp below the face: Cycles asks only whether it is above the horizon of the closure.
void BlockGatherer::add_below(std::size_t i, const TexelSample& texel, const LightSample& light) {
  if (!sampled_below(scene_.lights(), light)) return;
  const PathState& here = states_[i];
  const Vec3 start = own_->start_below(texel.triangle, here.weights, here.position, light.direction);
  ++rays_;
  const Visibility left =
      scene_.visibility({start, light.direction, shadow_tmax(light.distance, 2 * here.ray_offset)});
  if (left.blocked()) return;
  for (std::size_t k = 0; k < directions_; ++k) {
    const Vec3& normal = normals_[i * directions_ + k];
    const float other = normal.dot(light.direction) * inv_pi;
    if (!(other > 0)) continue;
    const float share = light.sample_bsdf ? power_heuristic(light.pdf, other) : 1;
    const float cosine = recipe_->cosine({normal, here.frame.normal, true}, light.direction);
    here.sums[k] +=
        light.radiance * (cosine * inv_pi * share / (light.pdf * lamp_samples)) * left.transmittance;
  }
}

/// The texel's own ray: what glows is added at once, what reflects is left in `found_`.
void BlockGatherer::trace_path(std::size_t i, Sampler& sampler) {
  const PathState& here = states_[i];
  SharedVertex& found = shared_vertices_[i];
  found.radiance = Vec3(0);
  const float choice = sampler.next1();
  const Vec3 direction = lobes_[i].sample(choice, sampler.next2());
  const float pdf = lobes_[i].pdf(direction);
  if (!(pdf > 0)) return;
  const auto by_bsdf = [&](float light_pdf) {
    return mis_weight(options_.light_sampling, options_.sample_bsdf, pdf, light_pdf * lamp_samples);
  };
  const Ray ray{here.position, direction, infinity};
  ++rays_;
  const PathHit end = trace_through(scene_, ray, sampler, [&](const Hit& hit, const Vec3& radiance) {
    const float other =
        scene_.lights().triangle_pdf(here.position, horizon(i), hit.triangle, direction, hit.distance);
    add(i, direction, radiance * (by_bsdf(other) / pdf));
  });
  if (!end.met) {
    const float other = scene_.lights().world_pdf(here.position, horizon(i), direction);
    add(i, direction, scene_.lights().world(direction) * (by_bsdf(other) / pdf) * end.weight());
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
  found = {vertex.position, vertex.face, vertex.start(), radiance / end.stop_probability, end.way};
}

/// Gives what texel `finder` found to every texel that sees it.
void BlockGatherer::share(std::size_t finder, std::size_t count) {
  const SharedVertex& found = shared_vertices_[finder];
  std::array<Ray, texels> rays;
  std::array<std::size_t, texels> who{};  // may see it
  std::size_t asked = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 way = found.position - states_[i].position;
    if (!(way.dot(found.face) < 0) || !(way.dot(states_[i].face) > 0) || i == finder) continue;
    const Vec3 path = found.target - states_[i].position;
    const float length = path.length();
    rays[asked] = {states_[i].position, path / length, length};
    who[asked++] = i;
  }
  rays_ += static_cast<std::int64_t>(asked);
  std::array<Visibility, texels> ways;
  std::size_t seeing = 0;
  for (std::size_t first = 0; first < asked; first += TraceScene::packet) {
    const std::size_t size = std::min(TraceScene::packet, asked - first);
    std::array<Visibility, TraceScene::packet> found_ways;
    scene_.visibility(std::span(&rays[first], size), found_ways.data());
    for (std::size_t k = 0; k < size; ++k) {
      if (found_ways[k].blocked()) continue;
      ways[seeing] = found_ways[k];
      who[seeing++] = who[first + k];
    }
  }
  ways[seeing] = found.way;
  who[seeing++] = finder;

  std::array<Vec3, texels> directions;
  std::array<float, texels> solid_angles{};  // for each area at the place
  float density = 0;
  for (std::size_t k = 0; k < seeing; ++k) {
    const Vec3 way = found.position - states_[who[k]].position;
    const float distance2 = way.dot(way), distance = std::sqrt(distance2);
    directions[k] = way / distance;
    // A place that is all but touched can come out under the face by rounding, and nothing bounds its weight
    // then.
    const float pdf = lobes_[who[k]].pdf(directions[k]);
    if (pdf > 0) solid_angles[k] = std::max(0.0F, -way.dot(found.face)) / (distance * distance2);
    density += pdf * solid_angles[k] * ways[k].transmit_probability;
  }
  if (!(density > 0) || !std::isfinite(density)) return;
  for (std::size_t k = 0; k < seeing; ++k)
    add(who[k], directions[k], found.radiance * (solid_angles[k] / density) * ways[k].transmittance);
}

}  // namespace rnmbake
