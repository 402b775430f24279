#include "pipeline/validate/validate_run.h"

#include "base/error.h"
#include "base/files.h"
#include "base/steps.h"
#include "base/text.h"
#include "config/recipe_names.h"
#include "pipeline/compare/compare.h"
#include "pipeline/probes/probes_run.h"
#include "pipeline/render/render_compare.h"
#include "pipeline/validate/decompose.h"
#include "pipeline/validate/validate_finding.h"
#include "pipeline/validate/validate_plan.h"
#include "pipeline/validate/validate_scope.h"
#include "probes/volume_file.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

using Recipe = BakingSettings::Recipe;
using Materials = SceneSettings::Materials;

// Time of a step, relative to one half of a receiver bake; about.
constexpr double receiver_weight = 1, recipe_weight = 1.5, trace_weight = 0.7;
constexpr double view_weight = 3, compare_weight = 0.1;
constexpr double study_weight = 2 * recipe_weight + trace_weight;

/// One line of the list that the validation works off.
struct Step {
  std::string name;
  double weight;
  std::function<void()> work;
};

/// Results of the steps, beside the files in their folders.
struct Findings {
  bool complete = true;  // no object failed
  SplitStudy study;
  std::optional<ViewComparison> view;
  std::optional<ProbeCheck> probes;
};

void bake(const ValidatePlan& plan, const BakeVariant& variant, int half, Findings& found) {
  const bool whole = variant.recipe == Recipe::receiver;
  const BakeOutcome outcome =
      bake_half(plan.base, whole ? plan.exported.list : plan.decomposed, variant, half);
  const std::size_t failed = count_failed(outcome.deliveries);
  if (failed == outcome.deliveries.size()) {
    fail(ExitCode::tasks_failed, "no object could be baked by {}; what went wrong stands above",
         variant.folder.string());
  }
  found.complete &= failed == 0;
}

Step bake_step(const ValidatePlan& plan, const BakeVariant& variant, int half, Findings& found) {
  return {fmt::format("baking {}, half {} of 2", variant.folder.string(), half + 1),
          variant.recipe == Recipe::receiver ? receiver_weight : recipe_weight,
          [&plan, variant, half, &found] { bake(plan, variant, half, found); }};
}

Step trace_step(const std::string& name, const ValidatePlan& plan, const TargetList& list,
                const TraceVariant& variant, Findings& found) {
  return {name, trace_weight, [&plan, &list, variant, &found] {
            found.complete &= count_failed(trace_variant(plan.base, list, variant).deliveries) == 0;
          }};
}

Step study_step(const ValidatePlan& plan, const Splitting& splitting, Findings& found) {
  return {fmt::format("study: {}, {}", splitting.name, counted(splitting.list.targets.size(), "target")),
          study_weight, [&plan, &splitting, &found] {
            found.study.points.push_back(study_point(plan.base, splitting, plan.truth, 64));
          }};
}

/// The receiver's lightmaps, put back into the scene.
ViewComparison view_of(const ValidatePlan& plan) {
  const DiffuseScene& scene = plan.exported.diffuse_scene;
  const ObjectSettings& object = plan.session.settings().object;
  const SceneLightmaps lightmaps(halves_of(plan, Recipe::receiver, Materials::lambert).first, scene);
  ViewCompareOptions options;
  options.render = render_options(*scene.camera, plan.view);
  options.render.view.samples = object.samples;
  options.render.view.seed = static_cast<std::uint64_t>(object.seed);
  options.render.view.threads = plan.truth.threads;
  options.render.bounces = plan.truth.bounces;
  return compare_view(plan.session, plan.exported, plan.scene, lightmaps, options);
}

/// Light probes by Blender, as `rnmbake probes --by blender` makes them, held against the reference.
ProbeCheck probes_of(const ValidatePlan& plan) {
  ProbesOptions options;
  options.places.probes = plan.probes;
  options.source = ProbeSource::blender;
  options.lambert = true;
  options.check = std::size_t(plan.probes);
  const ProbesResult result = run_probes(plan.session, plan.exported, plan.scene, plan.truth, options);
  const std::filesystem::path folder = plan.session.settings().output.dir / "probes";
  make_folders(folder);
  write_volumes(folder, result.volumes, result.about);
  return result.check;
}

std::vector<Step> steps_of(const ValidatePlan& plan, Findings& found) {
  std::vector<Step> steps;
  for (const BakeVariant& variant : bake_variants(plan))
    for (const int half : {0, 1}) steps.push_back(bake_step(plan, variant, half, found));
  const TargetList& all = plan.exported.list;
  steps.push_back(trace_step("tracing the truth", plan, all, truth_variant(plan), found));
  if (plan.bounce_limit_counts) {
    steps.push_back(trace_step(fmt::format("tracing the truth with {} bounces", plan.bounce_limit), plan, all,
                               limited_variant(plan), found));
  }
  for (const auto& [fault, variant] : emulations(plan)) {
    steps.push_back(trace_step(fmt::format("tracing the recipe's faults up to {}", fault), plan,
                               plan.decomposed, variant, found));
  }
  for (const Splitting& splitting : plan.study) steps.push_back(study_step(plan, splitting, found));
  if (plan.view > 0) steps.push_back({"the camera's view", view_weight, [&] { found.view = view_of(plan); }});
  if (plan.probes > 0)
    steps.push_back({"light probes", receiver_weight, [&] { found.probes = probes_of(plan); }});
  return steps;
}

Report compared(const ValidatePlan& plan, const TraceVariant& traced, Recipe recipe, bool with_maps) {
  const bool whole_recipe = recipe == Recipe::flat_normal_map && plan.own_materials;
  const Halves sides = halves_of(plan, recipe, whole_recipe ? Materials::full : Materials::lambert);
  CompareOptions options;
  options.candidate = {sides.first, sides.second, name_of(recipe)};
  options.reference = {folder_of(plan, traced), {}, "reference"};
  options.with_maps = with_maps;
  Report report = compare_lightmaps(options);
  report.not_followed = plan.not_followed;
  if (plan.bounce_limit_counts) {
    report.bounce_limit = bounce_limit(plan.bounce_limit, folder_of(plan, limited_variant(plan)),
                                       folder_of(plan, truth_variant(plan)));
  }
  return report;
}

/// Finding on the receiver alone, against the truth with the settings' limit of bounces, for that limit is no
/// error of the recipe.
std::string judge(const ValidatePlan& plan, const Report& receiver) {
  if (!plan.bounce_limit_counts) return receiver_finding(receiver);
  return receiver_finding(compared(plan, limited_variant(plan), Recipe::receiver, false));
}

DecomposeInput decompose_input(const ValidatePlan& plan) {
  DecomposeInput input;
  input.truth = folder_of(plan, truth_variant(plan));
  if (plan.bounce_limit_counts)
    input.emulated.push_back({"bounce limit", folder_of(plan, limited_variant(plan))});
  for (const auto& [fault, variant] : emulations(plan))
    input.emulated.push_back({fault, folder_of(plan, variant)});
  input.recipe = halves_of(plan, Recipe::flat_normal_map, Materials::lambert);
  input.receiver = halves_of(plan, Recipe::receiver, Materials::lambert);
  if (plan.own_materials) {
    input.own_recipe = halves_of(plan, Recipe::flat_normal_map, Materials::full);
    input.own_receiver = halves_of(plan, Recipe::receiver, Materials::full);
  }
  return input;
}

void add_notes(const ValidatePlan& plan, Report& report) {
  report.settings.emplace_back(
      "materials", plan.own_materials ? "lambert; own materials too, for the rows that are about them"
                                      : "lambert, which is what the scene's own are");
  if (plan.decomposed.targets.size() < plan.exported.list.targets.size()) {
    report.notes.push_back(fmt::format("The published recipe baked {} of {} targets (--decompose).",
                                       plan.decomposed.targets.size(), plan.exported.list.targets.size()));
  }
  if (plan.decomposes())
    report.notes.emplace_back(
        "The decomposition is of flat-normal-map minus the reference. Causes are added to the tracer one "
        "after the other; 'residual' is Cycles' bake minus the tracer with all of them.");
  for (std::string& note : scope_notes(plan.exported.diffuse_scene)) report.notes.push_back(std::move(note));
}

Validation judged(const ValidatePlan& plan, const Findings& found) {
  Validation result{compared(plan, truth_variant(plan), Recipe::receiver, true), {}, found.complete};
  result.inputs = plan.exported.diffuse_scene.survey.inputs;
  result.digest = plan.exported.diffuse_scene.survey.digest;
  Report& receiver = result.receiver;
  receiver.finding = judge(plan, receiver);
  receiver.study = found.study;
  if (plan.decomposes()) {
    receiver.decompositions = decompose(decompose_input(plan));
    const std::string of_recipe = recipe_finding(receiver.decompositions.front(), plan.not_followed);
    receiver.finding += "; " + of_recipe;
    result.recipe = compared(plan, truth_variant(plan), Recipe::flat_normal_map, true);
    result.recipe->finding = of_recipe + ".";
    result.recipe->decompositions = receiver.decompositions;
    result.recipe->study = found.study;
    add_notes(plan, *result.recipe);
  }
  receiver.finding += ".";
  add_notes(plan, receiver);
  if (found.probes && found.probes->agreement) {
    receiver.notes.push_back("Light probes: " + agreement_text(*found.probes->agreement, found.probes->mean) +
                             ".");
  }
  if (found.view) {
    receiver.notes.push_back(finding_of(*found.view));
    receiver.views.push_back(*found.view);
  }
  return result;
}

}  // namespace

Validation validate(BlenderSession& session, const std::vector<BasisDirection>& bases,
                    const ValidateOptions& options) {
  const ValidatePlan plan(session, bases, options);
  Findings found;
  Validation result;
  std::vector<Step> steps = steps_of(plan, found);
  steps.push_back({"comparing", compare_weight, [&] { result = judged(plan, found); }});
  double whole = 0;
  for (const Step& step : steps) whole += step.weight;
  Steps progress(steps.size(), whole);
  for (const Step& step : steps) {
    progress.begin(step.name, step.weight);
    step.work();
  }
  return result;
}

}  // namespace rnmbake
