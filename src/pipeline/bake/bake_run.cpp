#include "pipeline/bake/bake_run.h"

#include "bake/mirrors.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/names.h"
#include "base/object_notes.h"
#include "base/text.h"
#include "config/recipe_names.h"
#include "pipeline/dispatch/cycles_settings.h"
#include "pipeline/dispatch/dispatcher.h"
#include "pipeline/gather/choose_recipe.h"
#include "pipeline/gather/indirect_light.h"
#include "pipeline/lightmaps/bake_collector.h"
#include "pipeline/lightmaps/manifest.h"
#include "pipeline/lightmaps/target_facts.h"
#include "pipeline/scene/save_scene.h"
#include "scene/lighting.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

const char* name_of(BakingSettings::Dispatch dispatch) {
  using Mode = BakingSettings::Dispatch;
  return dispatch == Mode::basis ? "basis" : dispatch == Mode::object ? "object" : "scene";
}

/// Footprint of a texel in that version's bakes (docs/accuracy.md).
const char* footprint(const BlenderVersion& version) {
  return version.major >= 5 ? "texel" : "half texel";
}

constexpr double coarse_height = 0.1;  // texels

double distance_of(const Surface& surface) {
  return surface.triangles.empty() ? 0 : Vec3d(surface.triangles.front().corners[0].position).length();
}

/// Target whose receivers stand more than coarse_height over their faces, for want of float digits.
struct Coarse {
  std::size_t target;
  double distance;  // from the origin
};

/// Plan of the launches, with headers, horizon counts and receiver heights of each target.
struct PlannedBake {
  Plan plan;
  std::vector<LightmapHeader> headers;  // [targets], as the following two
  std::vector<HorizonCounts> horizons;
  std::vector<double> heights;  // of receivers over their faces, texels
  std::vector<Coarse> coarse;
  std::vector<std::string> small;           // targets that are too small for fences
  std::unique_ptr<IndirectLight> indirect;  // of recipe gather
};

bool by_receiver(const BakeSettings& settings) {
  return settings.bake.recipe != BakingSettings::Recipe::flat_normal_map;
}

/// Settings with the recipe that the scene is baked by.
BakeSettings settled(const BlenderSession& session, const BakeSubject& subject) {
  BakeSettings settings = session.settings();
  settings.bake.recipe = choose_recipe(settings, subject.survey, subject.list.settings);
  return settings;
}

LightmapMetadata metadata_of(const Target& target, const ObjectSettings& object, const BakeSettings& settings,
                             const BlenderInfo& blender) {
  LightmapMetadata metadata = target_metadata(target, object, settings.output);
  metadata.engine = name_of(BakingSettings::Engine::cycles);
  metadata.recipe = name_of(settings.bake.recipe);
  if (!by_receiver(settings) && settings.bake.correct_bump) metadata.recipe += ", correct-bump";
  metadata.horizon = !by_receiver(settings)                                ? "Blender's"
                     : object.horizon == ObjectSettings::Horizon::identity ? "identity"
                                                                           : "clamp";
  metadata.footprint = footprint(blender.version);
  metadata.bounces = settings.bake.bounces;
  metadata.blender_version = blender.version_text;
  return metadata;
}

/// Adds the tasks of one target, with all that its receivers need. Returns whether its surface is needed
/// again when the pictures come back.
bool plan_receivers(const BakeSettings& settings, const BakeSubject& subject, std::size_t i,
                    const Surface& surface, const std::vector<LightBall>& lights, PlannedBake& planned) {
  const Target& target = subject.list.targets[i];
  const ObjectSettings& object = subject.list.settings[i];
  std::vector<BasisDirection> bases = subject.bases;
  for (BasisDirection& basis : bases) basis.direction = in_frame(basis.direction, target);
  const Vec2 map(float(target.width), float(target.height));
  ReceiverPasses passes = make_receiver_passes(surface, bases, object.horizon, map);
  Fences fences = make_fences(surface, lights, map);
  planned.plan.guards->fences[i] = std::move(fences.strips);
  if (fences.left_out > 0) planned.small.push_back(target.key);
  note_glow(planned.plan.guards->glow_heights, subject.survey, target.object, surface);
  planned.heights[i] = height_in_texels(surface, map);
  if (planned.heights[i] > coarse_height) planned.coarse.push_back({i, distance_of(surface)});
  planned.horizons[i] = passes.counts;
  const bool needs_identity = passes.passes.size() > bases.size();
  const CyclesSettings cycles = cycles_settings(settings.bake, object);
  CyclesSettings of_receivers = cycles;
  if (planned.indirect) of_receivers.bounces = 0;
  add_receiver_tasks(planned.plan, plan_target(subject.survey, target), std::move(passes),
                     task_names(subject.bases), of_receivers);
  if (planned.indirect) planned.indirect->plan(planned.plan, target, cycles);
  return needs_identity;
}

/// What an object's pictures depend on that is baked as it is.
std::string object_content(const BakeSubject& subject, const Target& target, bool correct_bump) {
  std::string content = fmt::format("{} {} {} {} {} {}", target.key, target.uv_layer, uv_hash(*target.uv),
                                    target.tangent_layer, target.flip_green, correct_bump);
  for (const BasisDirection& basis : subject.bases)
    content += fmt::format(" {} {} {}", basis.direction.x, basis.direction.y, basis.direction.z);
  for (const std::uint32_t triangle : target.part.triangles) content += fmt::format(" {}", triangle);
  return hash128_hex(content);
}

void plan_target(const BakeSettings& settings, const BakeSubject& subject, std::size_t i,
                 const std::vector<LightBall>& lights, PlannedBake& planned, LostDirections& lost) {
  const Target& target = subject.list.targets[i];
  if (!by_receiver(settings)) {
    PlanTarget of = plan_target(subject.survey, target);
    of.content = object_content(subject, target, settings.bake.correct_bump);
    add_object_tasks(planned.plan, std::move(of), task_names(subject.bases),
                     cycles_settings(settings.bake, subject.list.settings[i]));
    if (!settings.output.frames) return;
  }
  const auto surface = std::make_shared<const Surface>(surface_of(subject.survey, target, lost));
  bool keep_surface = settings.output.frames;
  if (by_receiver(settings)) keep_surface |= plan_receivers(settings, subject, i, *surface, lights, planned);
  if (keep_surface) planned.headers[i].surface = surface;
}

/// Warns of places where the step of a float is no small part of a texel, in Cycles as everywhere.
void warn_of_coarse(const PlannedBake& planned, const std::vector<Target>& targets) {
  if (planned.coarse.empty()) return;
  const auto& worst = *std::ranges::max_element(planned.coarse, {},
                                                [&](const Coarse& it) { return planned.heights[it.target]; });
  const std::string more =
      planned.coarse.size() > 1 ? fmt::format(" (and {} more)", planned.coarse.size() - 1) : "";
  log::warn(
      "'{}'{} stands {:.0f} units from the origin, too far for 32-bit floats: shadows in its lightmap may "
      "be {:.2g} texels out of place; move the scene to the origin",
      targets[worst.target].key, more, worst.distance, planned.heights[worst.target]);
}

/// Warns of targets without fences: Cycles moves the start of rays by lengths that do not shrink with the
/// scene.
void warn_of_small(const std::vector<std::string>& small) {
  if (small.empty()) return;
  log::warn(
      "{}: too small, or too far from the origin: Cycles starts rays more than a texel off its faces, and "
      "light that runs along them may reach them; scale the scene up, or move it to the origin",
      first_names(small));
}

/// Warns of lights without shadow: Cycles sends them no shadow rays, so that they reach receivers through
/// their own face, too.
void warn_of_shadowless(const std::vector<LightInfo>& lights) {
  for (const LightInfo& light : lights) {
    if (std::ranges::find(light.outside_model, "no shadow") == light.outside_model.end()) continue;
    log::warn(
        "light '{}' casts no shadows: the basis maps of faces that are turned away from it take in some of "
        "its light; switch its shadows on",
        light.name);
  }
}

PlannedBake plan_bake(const BakeSettings& settings, const BakeSubject& subject, const BlenderInfo& blender) {
  const TargetList& list = subject.list;
  PlannedBake planned;
  if (by_receiver(settings)) planned.plan.guards.emplace().fences.resize(list.targets.size());
  if (settings.bake.recipe == BakingSettings::Recipe::gather)
    planned.indirect = std::make_unique<IndirectLight>(subject.survey, subject.bases, blender.version);
  planned.horizons.resize(list.targets.size());
  planned.heights.resize(list.targets.size());
  const std::vector<LightBall> lights = light_balls(subject.survey);
  FileStems stems(subject.earlier.stems());
  LostDirections lost;
  for (std::size_t i = 0; i < list.targets.size(); ++i) {
    const Target& target = list.targets[i];
    const ObjectSettings& object = list.settings[i];
    planned.headers.push_back(
        {stems.take(target.key), metadata_of(target, object, settings, blender), object.dilate, nullptr});
    plan_target(settings, subject, i, lights, planned, lost);
  }
  lost.warn();
  group_tasks(planned.plan, resolve_dispatch(settings.bake));
  group_mirrors(planned.plan);
  warn_of_coarse(planned, list.targets);
  warn_of_small(planned.small);
  if (by_receiver(settings)) warn_of_shadowless(subject.survey.lights);
  return planned;
}

/// Requests of the recipe.
BatchRecipe recipe_of(const BakeSettings& settings, const BakeContext& context) {
  if (by_receiver(settings)) return receiver_requests(settings, context.survey, context.plan);
  BatchRecipe recipe;
  recipe.in_passes = false;
  recipe.request = [&](const Batch& batch, int /*jobs*/, const std::filesystem::path& folder) {
    return object_request(context, batch, settings.bake.correct_bump, folder);
  };
  return recipe;
}

/// The scene with its UVs, and the manifest.
void write_records(BlenderSession& session, const BakeSubject& subject, const PlannedBake& planned,
                   const BakeSettings& settings, const BakeOutcome& outcome) {
  const SavedScene saved = save_scene_with_uvs(session, subject.survey, subject.blends.own,
                                               subject.earlier.add_to(uvs_of(subject.list.targets)));
  write_manifest({settings, subject.survey, subject.list, subject.bases, planned.headers, outcome.deliveries,
                  saved, subject.earlier,
                  BakeRecord{planned.horizons, planned.heights, name_of(resolve_dispatch(settings.bake)),
                             outcome.timings}});
}

}  // namespace

std::vector<BakePreview> preview_bake(BlenderSession& session, const BakeSubject& subject) {
  const PlannedBake planned = plan_bake(settled(session, subject), subject, session.blender().info());
  std::vector<BakePreview> all;
  for (const PlannedTarget& target : planned_targets(planned.plan)) {
    const PassCache& cache = subject.rules.cache;
    const bool is_kept =
        cache.is_on() && cache.has(PassCache::key_of(cache.key_of(target), target.samples()));
    all.push_back({planned.plan.targets[target.target].key, is_kept, target.samples()});
  }
  return all;
}

void plan_only(const BlenderSession& session, const BakeSubject& subject,
               const std::function<void(const Plan&, const BatchRecipe&)>& use) {
  const BakeSettings settings = settled(session, subject);
  const PlannedBake planned = plan_bake(settings, subject, session.blender().info());
  const BakeContext context{subject.survey, subject.list.targets, subject.bases, planned.plan};
  use(planned.plan, recipe_of(settings, context));
}

BakeOutcome run_bake(BlenderSession& session, const BakeSubject& subject) {
  const BakeSettings settings = settled(session, subject);
  const std::vector<Target>& targets = subject.list.targets;
  const BlenderInfo& blender = session.blender().info();
  const PlannedBake planned = plan_bake(settings, subject, blender);
  const BakeContext context{subject.survey, targets, subject.bases, planned.plan};
  log::info("baking {} x {} in {} of Blender {}", counted(targets.size(), "lightmap"),
            counted(subject.bases.size(), "basis"), counted(planned.plan.batches.size(), "launch"),
            blender.version_text);
  BakeCollector collector(context, settings.output, planned.headers, subject.rules.preview,
                          planned.indirect.get());
  BakeOutcome outcome;
  outcome.timings = run_batches(session, planned.plan, subject.blends.shown, recipe_of(settings, context),
                                collector, subject.rules);
  outcome.deliveries = collector.deliveries();
  if (may_be_lit(subject.survey)) warn_of_black(targets, outcome.deliveries);
  write_records(session, subject, planned, settings, outcome);
  return outcome;
}

}  // namespace rnmbake
