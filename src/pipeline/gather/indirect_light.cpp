#include "pipeline/gather/indirect_light.h"

#include "bake/mirrors.h"
#include "base/numeric/row_order.h"
#include "lightmap/fill.h"
#include "pipeline/lightmaps/target_facts.h"
#include "pipeline/reference/reference_plan.h"
#include "sampling/splitmix64.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

/// Paths behind each mirror: a mirror costs more than a path, but directions take away more noise than paths
/// do (bench/gather.py).
constexpr int paths_of_mirror = 2;

/// Geometry that diffuse rays meet; every material is opaque, for what lies behind a see-through one is seen
/// through mirrors alone.
DiffuseScene geometry_of(const SceneSurvey& survey, std::vector<char>& even, std::vector<char>& glows) {
  DiffuseScene scene;
  scene.survey.blender_version = survey.blender_version;
  scene.survey.meshes = survey.meshes;
  scene.survey.objects = survey.objects;
  std::map<std::string, int> numbers;
  const auto add = [&](const std::string& name, bool is_even, bool may_glow) {
    numbers[name] = static_cast<int>(scene.materials.size());
    scene.materials.push_back({});
    even.push_back(is_even && survey.gather.shares());
    glows.push_back(may_glow);
  };
  add("", true, false);  // an empty slot is plain grey
  for (const auto& [name, material] : survey.materials)
    add(name, material.even, material.emissive || !material.even);  // light may shine through the others
  for (const SceneObject& object : survey.objects) {
    std::vector<int> slots;
    for (const std::string& slot : object.slots) {
      const auto found = numbers.find(slot);
      slots.push_back(found != numbers.end() ? found->second : 0);
    }
    if (slots.empty()) slots.push_back(0);
    scene.object_materials.push_back(std::move(slots));
    scene.unlit.push_back(object.visible_to_bounces ? 0 : 1);
  }
  return scene;
}

/// Whether a ray may meet a lamp, with room for what mirrors are off by.
bool touches(const LightBall& lamp, const PrimaryRay& ray) {
  constexpr double off = 2e-3;  // radians
  const Vec3d direction(ray.direction);
  const Vec3d to_lamp = lamp.far ? lamp.place : lamp.place - Vec3d(ray.origin);
  const double along = to_lamp.dot(direction), distance = to_lamp.length();
  const double beside = std::sqrt(std::max(0.0, distance * distance - along * along));
  return beside <= lamp.radius + off * distance && along > -lamp.radius;
}

Vec3 radiance_at(const FloatImage& picture, std::size_t mirror) {
  const auto width = static_cast<std::size_t>(picture.width());
  const auto x = static_cast<int>(mirror % width), row = static_cast<int>(mirror / width);
  return vec3_at(picture, x, other_row(row, picture.height()));
}

}  // namespace

IndirectLight::IndirectLight(const SceneSurvey& survey, const std::vector<BasisDirection>& bases,
                             const BlenderVersion& version)
    : bases_(bases),
      is_complete_(survey.gather.shares()),
      lamps_(light_balls(survey)),
      scene_(geometry_of(survey, even_, glows_)),
      trace_scene_(std::make_unique<TraceScene>(scene_, survey.blender_version)) {
  for (LightBall& lamp : lamps_) {
    if (!lamp.far) lamp.place -= trace_scene_->origin();
  }
  ReferencePlan of_version;
  follow(version, ReferenceSettings::Footprint::automatic, of_version);
  common_.footprint = of_version.footprint;
  common_.past_edge = of_version.past_edge;
}

IndirectLight::Meets IndirectLight::meets(const PrimaryRay& ray) const {
  if (!is_complete_) return Meets::light;
  for (const LightBall& lamp : lamps_) {
    if (touches(lamp, ray)) return Meets::light;
  }
  Hit hit;
  std::vector<TransparentHit> none;  // all materials are opaque here
  if (!trace_scene_->intersect({ray.origin, ray.direction, infinity}, hit, none)) return Meets::nothing;
  const std::uint32_t material = trace_scene_->triangles().material[hit.triangle];
  return glows_[material] != 0 ? Meets::light : Meets::surface;
}

MirrorGather IndirectLight::half_of(const Member& member, std::size_t half) const {
  GatherOptions options = member.options;
  options.seed = hash_of(options.seed, half);
  return {*trace_scene_, even_, member.target, options};
}

void IndirectLight::plan(Plan& plan, const Target& target, const CyclesSettings& cycles) {
  if (cycles.bounces == 0) return;
  const std::size_t index = plan.targets.size() - 1;
  LostDirections told;  // where the receivers were made
  Member& member = members_[index];
  member.surface = surface_of(scene_.survey, target, told, trace_scene_->origin());
  member.options = common_;
  member.options.directions = bases_;
  for (BasisDirection& basis : member.options.directions) basis.direction = in_frame(basis.direction, target);
  CyclesSettings of_mirrors = cycles;
  of_mirrors.mirrors = true;
  of_mirrors.noise = 0;
  of_mirrors.samples = std::min(paths_of_mirror, cycles.samples);
  const int directions = (cycles.samples + of_mirrors.samples - 1) / of_mirrors.samples;
  member.options.samples = std::max(1, (directions + 1) / 2);
  member.options.seed = static_cast<std::uint64_t>(cycles.seed);
  member.target = {&member.surface, target.object, target.width, target.height, 0};
  for (const std::size_t half : {0U, 1U}) {
    const std::vector<PrimaryRay> rays = half_of(member, half).rays();
    std::vector<Meets> met(rays.size());
    tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) { met[i] = meets(rays[i]); });
    for (const Meets what : {Meets::surface, Meets::light}) {
      std::vector<Mirror> mirrors;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (met[i] != what) continue;
        const Vec3d place = Vec3d(rays[i].origin) + trace_scene_->origin();
        mirrors.push_back({mirror_position(place, rays[i].face), rays[i].direction});
        member.rays[half].push_back(static_cast<std::uint32_t>(i));
      }
      add_mirror_tasks(plan, index, half, what == Meets::light, mirrors, of_mirrors);
    }
  }
}

BouncedLight IndirectLight::gather(std::size_t target, const Plan& plan,
                                   const std::map<std::size_t, BakedPicture>& pictures) const {
  BouncedLight result;
  const auto found = members_.find(target);
  if (found == members_.end()) return result;
  for (const std::size_t half : {0U, 1U}) {
    const MirrorGather mirrors = half_of(found->second, half);
    std::vector<Vec3> radiance(mirrors.size(), Vec3(0));
    auto ray = found->second.rays[half].begin();
    for (const auto& [rect, picture] : pictures) {  // in the order in which they were planned
      const ReceiverPass& pass = plan.rects[rect].pass;
      if (pass.role != ReceiverPass::Role::mirrors || pass.basis != half) continue;
      const FloatImage mean = picture.mean();
      for (std::size_t i = 0; i < pass.mirrors.size(); ++i) radiance[*ray++] = radiance_at(mean, i);
    }
    result[half] = mirrors.gather(radiance).light;
    for (GatheredDirection& direction : result[half].directions)
      dilate(direction.radiance, result[half].coverage, 1);
  }
  return result;
}

}  // namespace rnmbake
