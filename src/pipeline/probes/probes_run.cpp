#include "pipeline/probes/probes_run.h"

#include "base/error.h"
#include "base/log.h"
#include "base/names.h"
#include "base/progress.h"
#include "base/text.h"
#include "probes/fill_probes.h"
#include "process/stop.h"
#include "trace/probes/gather_probes.h"

#include <algorithm>
#include <span>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

DirectLight direct_light(ProbeLights lights) {
  return {lights == ProbeLights::all, lights != ProbeLights::bounced};
}

/// Takes moving objects out of the scene, for light and for rays.
void take_out(const std::vector<char>& dynamic, DiffuseScene& scene) {
  scene.unlit.resize(scene.survey.objects.size(), 0);
  for (std::size_t i = 0; i < dynamic.size(); ++i)
    if (dynamic[i] != 0) scene.unlit[i] = 1;
}

/// Probes that need light of their own: those that no neighbour can stand in for, too.
std::vector<LightProbe*> probes_to_light(std::vector<ProbeVolume>& volumes) {
  std::vector<LightProbe*> wanted;
  for (ProbeVolume& volume : volumes) {
    for (LightProbe& probe : volume.probes)
      if (is_valid(probe) || !volume.grid) wanted.push_back(&probe);
  }
  return wanted;
}

void light_by_reference(const BlenderSession& session, const TraceScene& scene, const ReferencePlan& plan,
                        ProbeLights lights, std::span<LightProbe* const> probes) {
  const ObjectSettings& settings = session.settings().object;
  ProbeGatherOptions options;
  options.directions.assign(probe_directions().begin(), probe_directions().end());
  options.direct = direct_light(lights);
  options.samples = settings.samples;
  options.bounces = plan.bounces;
  options.seed = static_cast<std::uint64_t>(settings.seed);
  options.threads = plan.threads;
  std::vector<Vec3> positions;
  for (const LightProbe* probe : probes) positions.emplace_back(probe->position - scene.origin());
  Progress progress("tracing", progress_for(log::is_quiet(), log::is_jsonl()));
  const std::vector<GatheredProbe> gathered = gather_probes(
      scene, positions, options, [&](double share) { progress.update(share, "probes"); },
      [] { return StopRequest::requested(); });
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  for (std::size_t i = 0; i < probes.size(); ++i) {
    std::ranges::copy(gathered[i].irradiance, probes[i]->irradiance.begin());
    std::ranges::copy(gathered[i].standard_error, probes[i]->standard_error.begin());
    probes[i]->harmonics = gathered[i].harmonics;
  }
}

/// Settles all volumes, and says what became of them.
void settle(const TraceScene& scene, const SettleOptions& options, std::vector<ProbeVolume>& volumes) {
  std::size_t probes = 0, buried = 0;
  for (ProbeVolume& volume : volumes) {
    const SettleCounts counts = settle_probes(scene, options, volume);
    probes += volume.probes.size();
    buried += counts.buried;
    if (counts.moved > 0)
      log::info("'{}': {} moved out of geometry", volume.name, counted(counts.moved, "probe"));
    if (counts.buried > 0) {
      log::warn("'{}': {} of {} stand inside of something or behind a wall{}", volume.name, counts.buried,
                counted(volume.probes.size(), "probe"),
                volume.grid ? "; they get the light of their neighbours" : "; move them");
    }
  }
  if (buried == probes) {
    fail(ExitCode::invalid_input,
         "all {} see the backs of faces: they stand inside of something, or the faces around them point the "
         "wrong way. Move the box, turn the faces (in Blender: Mesh > Normals > Recalculate), or pass "
         "--two-sided where faces have no back",
         counted(probes, "probe"));
  }
}

}  // namespace

ProbesResult run_probes(BlenderSession& session, ExportResult& exported, const ReferencePlan& plan,
                        const ProbesOptions& options) {
  DiffuseScene& diffuse = exported.diffuse_scene;
  const std::vector<char> dynamic = dynamic_objects(diffuse.survey, options.dynamic);
  ProbesResult result;
  result.volumes = place_volumes(diffuse.survey, options.places, dynamic);
  take_out(dynamic, diffuse);
  const TraceScene scene(diffuse, plan.blender_version);
  settle(scene, options.settle, result.volumes);
  const std::vector<LightProbe*> probes = probes_to_light(result.volumes);
  log::info("lighting {} in {}", counted(probes.size(), "probe"), counted(result.volumes.size(), "volume"));
  light_by_reference(session, scene, plan, options.lights, probes);
  for (ProbeVolume& volume : result.volumes) fill_probes(volume);
  const ObjectSettings& settings = session.settings().object;
  result.about = {{"scene", file_word(session.settings().scene.file.stem().string())},
                  {"blender", plan.blender_version},
                  {"source", "reference"},
                  {"lights", probe_lights_names[std::size_t(options.lights)]},
                  {"samples", settings.samples},
                  {"seed", settings.seed},
                  {"bounces", plan.bounces},
                  {"dynamic", options.dynamic}};
  return result;
}

}  // namespace rnmbake
