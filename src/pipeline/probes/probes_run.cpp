#include "pipeline/probes/probes_run.h"

#include "base/error.h"
#include "base/log.h"
#include "base/names.h"
#include "base/progress.h"
#include "base/text.h"
#include "pipeline/probes/bake_probes.h"
#include "pipeline/probes/reference_light.h"
#include "pipeline/run/result_store.h"
#include "pipeline/scene/scene_key.h"
#include "probes/fill_probes.h"
#include "probes/probe_tree.h"
#include "probes/regular_volume.h"
#include "sampling/sampler.h"
#include "scene/lighting.h"

#include <algorithm>
#include <span>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

DirectLight direct_light(ProbeLights lights) {
  return {lights == ProbeLights::all, lights != ProbeLights::bounced};
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

ProbeGatherOptions gather_options(const ObjectSettings& settings, const ReferencePlan& plan,
                                  ProbeLights lights) {
  ProbeGatherOptions options = probe_gathering();
  options.direct = direct_light(lights);
  options.samples = settings.samples;
  options.bounces = plan.bounces;
  options.seed = static_cast<std::uint64_t>(settings.seed);
  options.threads = plan.threads;
  return options;
}

void trace(const TraceScene& scene, const ProbeGatherOptions& options, std::span<LightProbe* const> probes) {
  Progress progress("tracing", progress_for(log::is_quiet(), log::is_jsonl()));
  light_by_reference(scene, probes, options, [&](double share) { progress.update(share, "probes"); });
}

/// Keys of the objects that move.
std::vector<std::string> keys_of(const SceneSurvey& survey, const std::vector<char>& dynamic) {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < dynamic.size(); ++i)
    if (dynamic[i] != 0) keys.push_back(survey.objects[i].key);
  return keys;
}

/// A probe that Blender failed at counts as one that stands in a wall: its neighbours stand in for it.
void light_by_blender(BlenderSession& session, const ExportResult& exported, const ProbesOptions& options,
                      const std::vector<char>& dynamic, std::span<LightProbe* const> probes) {
  std::vector<Vec3d> positions;
  for (const LightProbe* probe : probes) positions.push_back(probe->position);
  const SceneSurvey& survey = exported.diffuse_scene.survey;
  Store store = open_store(session.settings());
  DispatchRules rules;
  if (!options.lambert)
    rules.cache = PassCache(store, scene_key(session, survey));  // albedo is baked anew each time
  const BakedProbes baked =
      bake_probes(session, survey, options.lambert ? exported.blends->shown : exported.blends->own,
                  {positions, probe_directions(), options.lights, keys_of(survey, dynamic), rules});
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (!baked.baked[i]) probes[i]->validity = 0;
    std::copy_n(baked.irradiance.begin() + std::ptrdiff_t(i * probe_direction_count), probe_direction_count,
                probes[i]->irradiance.begin());
    probes[i]->standard_error.fill(Vec3(0));
    if (!baked.standard_errors.empty())
      std::copy_n(baked.standard_errors.begin() + std::ptrdiff_t(i * probe_direction_count),
                  probe_direction_count, probes[i]->standard_error.begin());
    probes[i]->harmonics = harmonics_of(probes[i]->irradiance);
  }
}

constexpr const char* turn_faces =
    "they stand inside of something, or the faces around them point the wrong way. Move the box, turn the "
    "faces (in Blender: Mesh > Normals > Recalculate), or pass --two-sided where faces have no back";

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
    fail(ExitCode::invalid_input, "all {} see the backs of faces: {}", counted(probes, "probe"), turn_faces);
  }
  if (2 * buried > probes) log::warn("most probes see the backs of faces: {}", turn_faces);
}

/// Adds probes where the reference finds more light between them than they say.
void refine(const TraceScene& scene, const ProbesOptions& options, const ProbeGatherOptions& gathering,
            std::vector<ProbeVolume>& volumes) {
  for (ProbeVolume& volume : volumes) {
    const LightProbes light = [&](std::span<LightProbe* const> probes, std::uint64_t round) {
      ProbeGatherOptions fresh = gathering;
      fresh.seed = hash_of(hash_of(gathering.seed, 3), round);
      trace(scene, fresh, probes);
    };
    const std::size_t before = volume.probes.size();
    const RefineCounts counts = refine_probes(scene, options.settle, options.refine, light, volume);
    if (!volume.tree) continue;
    log::info("'{}': {} divided, {} added to {} of {} traced", volume.name, counted(counts.divided, "cell"),
              counted(volume.probes.size() - before, "probe"), before, counts.lit);
  }
}

/// Trees on regular grids, as fine as their smallest cells. What was between probes is looked around from.
std::vector<ProbeVolume> regular_boxes(const TraceScene& scene, const SettleOptions& options,
                                       const std::vector<ProbeVolume>& volumes) {
  std::vector<ProbeVolume> boxes;
  for (const ProbeVolume& volume : volumes) {
    if (!volume.tree) {
      boxes.push_back(volume);
      continue;
    }
    const int level = depth_of(*volume.grid, *volume.tree);
    RegularVolume made = regular_volume(volume, level);
    look_again(scene, options, made.interpolated, reach_of(*volume.grid, level), made.volume);
    log::info("'{}': {} of {} on the regular grid are interpolated", volume.name, made.interpolated.size(),
              counted(made.volume.probes.size(), "probe"));
    boxes.push_back(std::move(made.volume));
  }
  return boxes;
}

/// What lights the scene may all be left out of the probes' light.
void warn_of_black(const SceneSurvey& survey, std::span<LightProbe* const> probes) {
  const auto is_black = [](const LightProbe* probe) {
    return std::ranges::all_of(probe->irradiance, [](const Vec3& light) { return light == Vec3(0); });
  };
  if (may_be_lit(survey) && std::ranges::all_of(probes, is_black))
    log::warn("all probes are black: no light reaches them, or --lights and --dynamic leave out what does");
}

}  // namespace

void take_out(const std::vector<std::string>& dynamic, DiffuseScene& scene) {
  const std::vector<char> moves = dynamic_objects(scene.survey, dynamic);
  scene.unlit.resize(moves.size(), 0);
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (moves[i] != 0) scene.unlit[i] = 1;
}

ProbesResult run_probes(BlenderSession& session, const ExportResult& exported, const TraceScene& scene,
                        const ReferencePlan& plan, const ProbesOptions& options) {
  const DiffuseScene& diffuse = exported.diffuse_scene;
  const std::vector<char> dynamic = dynamic_objects(diffuse.survey, options.dynamic);
  ProbesResult result;
  result.volumes = place_volumes(diffuse.survey, options.places, dynamic);
  if (options.source == ProbeSource::blender && !exported.blends)
    fail(ExitCode::usage, "--by blender needs the .blend; a .rnmscene holds what the tracer needs alone");
  settle(scene, options.settle, result.volumes);
  const ObjectSettings& settings = session.settings().object;
  const ProbeGatherOptions gathering = gather_options(settings, plan, options.lights);
  const bool by_blender = options.source == ProbeSource::blender, refined = options.refine.error > 0;
  // Where probes are to stand is found by the reference, which knows its noise; then Blender lights them all
  // in one bake.
  if (!by_blender || refined) {
    const std::vector<LightProbe*> probes = probes_to_light(result.volumes);
    log::info("lighting {} in {}", counted(probes.size(), "probe"), counted(result.volumes.size(), "volume"));
    trace(scene, gathering, probes);
  }
  if (refined) refine(scene, options, gathering, result.volumes);
  if (by_blender) light_by_blender(session, exported, options, dynamic, probes_to_light(result.volumes));
  warn_of_black(diffuse.survey, probes_to_light(result.volumes));
  for (ProbeVolume& volume : result.volumes) fill_probes(volume);
  if (options.check > 0) {
    result.check = check_between(scene, result.volumes, gathering, options.check);
    if (by_blender) {
      ProbeGatherOptions limited = gathering;
      limited.bounces = session.settings().bake.bounces;  // as those of the bake
      result.check.agreement = check_at_probes(scene, result.volumes, limited, options.check);
      result.check.agreement->own_materials = !options.lambert;
    }
  }
  if (options.regular) result.regular = regular_boxes(scene, options.settle, result.volumes);
  result.about = {{"scene", file_word(session.settings().scene.file.stem().string())},
                  {"blender", plan.blender_version},
                  {"source", by_blender ? "blender" : "reference"},
                  {"lights", probe_lights_names[std::size_t(options.lights)]},
                  {"samples", settings.samples},
                  {"seed", settings.seed},
                  {"bounces", plan.bounces},
                  {"dynamic", options.dynamic}};
  if (refined) result.about["refined"] = {{"error", options.refine.error}, {"levels", options.refine.levels}};
  if (options.check > 0) result.about["check"] = check_json(result.check);
  return result;
}

}  // namespace rnmbake
