#include "pipeline/render/render_probes.h"

#include "base/error.h"
#include "pipeline/probes/place_volumes.h"
#include "pipeline/render/probe_spheres.h"
#include "probes/volume_file.h"

#include <algorithm>
#include <limits>

namespace rnmbake {
namespace {

/// How far a place lies outside of a box, in steps of its probes.
double distance_outside(const ProbeGrid& grid, const Vec3d& place) {
  const Vec3d at = grid.coordinates(place);
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = grid.counts[std::size_t(axis)] - 1;
    most = std::max({most, -at[axis], at[axis] - last});
  }
  return most;
}

}  // namespace

SceneProbes::SceneProbes(const std::filesystem::path& path, const DiffuseScene& scene,
                         const std::vector<std::string>& dynamic) {
  StoredVolumes stored = read_volumes(path);
  for (ProbeVolume& volume : stored.volumes)
    if (volume.grid) volumes_.push_back(std::move(volume));
  if (volumes_.empty())
    fail(ExitCode::unsupported, "{} holds lists of points; only boxes of probes light what lies between",
         path.string());
  held_ = probe_lights_of(stored.about.value("lights", "all")).value_or(ProbeLights::all);
  auto patterns = dynamic;
  if (patterns.empty()) patterns = stored.about.value("dynamic", std::vector<std::string>());
  lit_ = dynamic_objects(scene.survey, patterns);
  if (patterns.empty()) std::ranges::fill(lit_, 1);
}

void SceneProbes::show_spheres(DiffuseScene& scene) {
  first_sphere_ = scene.survey.objects.size();
  add_probe_spheres(volumes_, scene);
  lit_.assign(scene.survey.objects.size(), 1);
}

ProbeLight::ProbeLight(const SceneProbes& probes, const ProbeLookup& lookup)
    : probes_(probes), encoding_(lookup.encoding) {
  for (const ProbeVolume& volume : probes.volumes()) {
    samplers_.emplace_back(volume, lookup.encoding, lookup.test);
    for (const LightProbe& probe : volume.probes) spheres_.push_back(encoded_probe(probe, encoding_));
  }
}

Vec3 ProbeLight::irradiance(std::size_t object, const Vec3d& place, const Vec3& normal) const {
  const auto sphere = probes_.sphere_of(object);
  const Vec3 light = sphere ? decoded_probe(spheres_[*sphere], encoding_, normal) : between(place, normal);
  return {std::max(0.0F, light.x), std::max(0.0F, light.y), std::max(0.0F, light.z)};
}

Vec3 ProbeLight::between(const Vec3d& place, const Vec3& normal) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < samplers_.size() && least > 0; ++i) {
    const double distance = distance_outside(*probes_.volumes()[i].grid, place);
    if (distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return samplers_[nearest].irradiance(place, normal);
}

}  // namespace rnmbake
