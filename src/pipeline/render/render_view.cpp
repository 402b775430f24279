#include "pipeline/render/render_view.h"

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "blender/blender_session.h"
#include "pipeline/render/render_surfaces.h"
#include "process/stop.h"
#include "trace/path.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

constexpr std::array variants{DecodeVariant::single, DecodeVariant::squared, DecodeVariant::linear,
                              DecodeVariant::vrad, DecodeVariant::encoded};

/// Lights one place after the other.
class Shader {
 public:
  Shader(const TraceScene& scene, const SurfaceLights& lights, const Lighting& lighting, int bounces)
      : scene_(scene),
        lights_(lights),
        lighting_(lighting),
        surfaces_(scene, lights.lightmaps == nullptr ? std::map<std::size_t, std::string>{}
                                                     : lights.lightmaps->tangent_layers()) {
    path_.bounces = bounces < 0 ? -1 : bounces + 1;
    path_.before = 0;
    if (lighting.kind == Lighting::Kind::probes) {
      if (lights.probes == nullptr) fail(ExitCode::usage, "{} needs light probes", name_of(lighting));
      probe_light_.emplace(*lights.probes, lighting.lookup);
      const ProbeLights held = lights.probes->held();
      own_lights_.sampled = {held != ProbeLights::all, held == ProbeLights::bounced};
      own_lights_.bounces = 1;
      own_lights_.before = 0;
      own_lights_.sample_bsdf = false;
    }
    if (lighting.kind == Lighting::Kind::decoded && lights.lightmaps == nullptr)
      fail(ExitCode::usage, "{} needs lightmaps", name_of(lighting));
    if (takes_lightmaps()) decoders_ = lights_.lightmaps->decoders(lighting.variant);
  }

  [[nodiscard]] Vec3 reflected(const Vertex& vertex, Sampler& sampler) const {
    if (lighting_.kind == Lighting::Kind::none) return albedo(vertex);
    if (lighting_.kind == Lighting::Kind::truth) return traced(vertex, sampler);
    if (probe_light_ && lights_.probes->lights(surfaces_.object_of(vertex)))
      return by_probes(vertex, sampler);
    if (!takes_lightmaps()) return traced(vertex, sampler);
    const int number = lights_.lightmaps->find(surfaces_.object_of(vertex), surfaces_.source_of(vertex));
    return number < 0 ? traced(vertex, sampler) : decoded(vertex, static_cast<std::size_t>(number));
  }

 private:
  [[nodiscard]] Vec3 albedo(const Vertex& vertex) const {
    return scene_.materials().albedo(vertex.material, vertex.uv);
  }

  [[nodiscard]] bool takes_lightmaps() const {
    using Kind = Lighting::Kind;
    return lights_.lightmaps != nullptr &&
           (lighting_.kind == Kind::decoded || lighting_.kind == Kind::probes);
  }

  /// What the probes hold, and what an engine's own lights add to it.
  [[nodiscard]] Vec3 by_probes(Vertex vertex, Sampler& sampler) const {
    vertex.normal = surfaces_.to_world(vertex, surfaces_.mapped_normal(vertex));
    const Vec3 light =
        albedo(vertex) * probe_light_->irradiance(surfaces_.object_of(vertex),
                                                  Vec3d(vertex.position) + scene_.origin(), vertex.normal);
    if (!own_lights_.sampled.lamps) return light;
    std::int64_t rays = 0;
    return light + reflected_radiance(scene_, vertex, own_lights_, sampler, rays);
  }

  [[nodiscard]] Vec3 decoded(const Vertex& vertex, std::size_t number) const {
    const Vec2 uv = surfaces_.at(vertex, *lights_.lightmaps->placed()[number].uv);
    return albedo(vertex) * decoders_[number].at(uv, surfaces_.mapped_normal(vertex));
  }

  /// Light over the face, weighed by the cosine with the normal map's normal.
  [[nodiscard]] Vec3 traced(Vertex vertex, Sampler& sampler) const {
    vertex.normal = surfaces_.to_world(vertex, surfaces_.mapped_normal(vertex));
    std::int64_t rays = 0;
    return reflected_radiance(scene_, vertex, path_, sampler, rays);
  }

  const TraceScene& scene_;
  SurfaceLights lights_;
  Lighting lighting_;
  RenderSurfaces surfaces_;
  PathOptions path_;
  PathOptions own_lights_;  // of an engine, beside what its probes hold
  std::vector<LightmapDecoder> decoders_;
  std::optional<ProbeLight> probe_light_;
};

}  // namespace

std::optional<Lighting> lighting_of(const std::string& name) {
  if (name == "truth") return Lighting{Lighting::Kind::truth, {}};
  if (name == "none") return Lighting{Lighting::Kind::none, {}};
  if (name == "probes") return Lighting{Lighting::Kind::probes, {}};
  for (const DecodeVariant variant : variants) {
    if (name == name_of(variant)) return Lighting{Lighting::Kind::decoded, variant};
  }
  return std::nullopt;
}

std::string name_of(const Lighting& lighting) {
  switch (lighting.kind) {
    case Lighting::Kind::decoded:
      return name_of(lighting.variant);
    case Lighting::Kind::truth:
      return "truth";
    case Lighting::Kind::probes:
      return "probes";
    case Lighting::Kind::none:
      break;
  }
  return "none";
}

const Camera& camera_of(const DiffuseScene& scene) {
  if (scene.camera) return *scene.camera;
  fail(ExitCode::invalid_input,
       "{}: the scene has no camera that this can look through (none at all, or a panorama); add one in "
       "Blender (Add > Camera) and save",
       scene.survey.scene_file);
}

View render_view(const TraceScene& scene, const SurfaceLights& lights, const Lighting& lighting,
                 const RenderOptions& options) {
  const Shader shader(scene, lights, lighting, options.bounces);
  Progress progress("rendering", progress_for(log::is_quiet(), log::is_jsonl()));
  View view = trace_view(
      scene, camera_of(scene.diffuse_scene()), options.view,
      [&](const Vertex& vertex, Sampler& sampler) { return shader.reflected(vertex, sampler); },
      [&](double share) { progress.update(share, name_of(lighting)); },
      [] { return StopRequest::requested(); });
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  return view;
}

}  // namespace rnmbake
