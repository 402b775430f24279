#include "pipeline/validate/validate_plan.h"

#include "base/error.h"
#include "base/names.h"
#include "config/recipe_names.h"
#include "pipeline/run/result_store.h"
#include "pipeline/scene/fit_camera.h"
#include "pipeline/validate/validate_scope.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

using Recipe = BakingSettings::Recipe;
using Materials = SceneSettings::Materials;

ExportResult exported_for(BlenderSession& session, const ValidateOptions& options) {
  ExportResult exported = export_scene(session, options.anew);
  if (options.view > 0) give_camera(exported);
  return exported;
}

ReferencePlan without_limit(ReferencePlan plan) {
  plan.bounces = -1;
  return plan;
}

/// The targets whose objects fit a pattern; the word "none" alone chooses none.
TargetList chosen(const ExportResult& exported, const std::vector<std::string>& patterns) {
  TargetList list;
  if (patterns == std::vector<std::string>{"none"}) return list;
  const auto& objects = exported.diffuse_scene.survey.objects;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < exported.list.targets.size(); ++i) {
    const SceneObject& object = objects[exported.list.targets[i].object];
    names.insert(names.end(), {object.name, object.key});
    if (std::ranges::none_of(patterns, [&](const std::string& pattern) {
          return glob_match(pattern, object.name) || glob_match(pattern, object.key);
        }))
      continue;
    list.targets.push_back(exported.list.targets[i]);
    list.settings.push_back(exported.list.settings[i]);
  }
  const auto lost = unmatched(patterns, names);
  if (!lost.empty()) {
    fail(ExitCode::usage, "--decompose: no object that is baked is called '{}'{}", lost.front(),
         did_you_mean(lost.front(), names));
  }
  return list;
}

/// Whether some object has a material that is not diffuse, for which the lambert scene has a substitute.
bool has_own_materials(const DiffuseScene& scene) {
  return std::ranges::any_of(scene.outside, [](const OutsideModel& outside) {
    return outside.owner.starts_with("object ") && outside.what != outside.untraced;
  });
}

}  // namespace

ValidatePlan::ValidatePlan(BlenderSession& used, const std::vector<BasisDirection>& bases,
                           const ValidateOptions& options)
    : session(used),
      view(options.view),
      probes(options.probes),
      exported(exported_for(used, options)),
      truth(without_limit(plan_reference(used.config(), exported.diffuse_scene.survey.blender_version))),
      scene(exported.diffuse_scene, truth.blender_version),
      store(open_store(used.settings())),
      base{used, exported, scene, bases, store, options.anew},
      decomposed(chosen(exported, options.decompose)),
      own_materials(has_own_materials(exported.diffuse_scene)),
      bounce_limit(used.settings().bake.bounces),
      bounce_limit_counts(bounces_matter(exported.diffuse_scene, bounce_limit)),
      not_followed(rnmbake::not_followed(exported.diffuse_scene)) {
  check_light(used.config(), exported.diffuse_scene.survey);
  if (options.split_study) study = splittings(exported);
}

BakeVariant bake_variant(Recipe recipe, Materials materials) {
  const bool lambert = materials == Materials::lambert;
  std::filesystem::path folder = name_of(recipe);
  if (!lambert) folder += "-own-materials";
  return {recipe, materials, folder, (recipe == Recipe::receiver ? 0 : 2) + (lambert ? 0 : 4)};
}

std::vector<BakeVariant> bake_variants(const ValidatePlan& plan) {
  std::vector<BakeVariant> list;
  for (const Materials materials : {Materials::lambert, Materials::full}) {
    if (materials == Materials::full && !plan.own_materials) break;
    list.push_back(bake_variant(Recipe::receiver, materials));
    if (plan.decomposes()) list.push_back(bake_variant(Recipe::flat_normal_map, materials));
  }
  return list;
}

TraceVariant truth_variant(const ValidatePlan& plan) {
  return {plan.truth, "reference", 8, "tracing"};
}

TraceVariant limited_variant(const ValidatePlan& plan) {
  TraceVariant variant = truth_variant(plan);
  if (!plan.bounce_limit_counts) return variant;
  variant.plan.bounces = plan.bounce_limit;
  variant.folder = std::filesystem::path("emulation") / "0-bounce-limit";
  return variant;
}

std::vector<Emulation> emulations(const ValidatePlan& plan) {
  std::vector<Emulation> list;
  if (!plan.decomposes()) return list;
  const RecipeFaults of_version = faults_of(blender_version_of(plan.truth.blender_version, "the scene"));
  TraceVariant variant = limited_variant(plan);
  variant.plan.flat_normal_map = true;
  int number = 0;
  for (const NamedFault& fault : all_faults()) {
    ++number;
    if (!(of_version.*fault.on)) continue;
    variant.plan.faults.*fault.on = true;
    variant.folder = std::filesystem::path("emulation") / fmt::format("{}-{}", number, fault.flag);
    ++variant.seed;
    list.push_back({fault.words, variant});
  }
  return list;
}

Halves halves_of(const ValidatePlan& plan, Recipe recipe, Materials materials) {
  const BakeVariant variant = bake_variant(recipe, materials);
  return {half_folder(plan.base, variant, 0), half_folder(plan.base, variant, 1)};
}

std::filesystem::path folder_of(const ValidatePlan& plan, const TraceVariant& variant) {
  return plan.session.settings().output.dir / variant.folder;
}

}  // namespace rnmbake
