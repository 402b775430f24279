#include "pipeline/validate/validate_run.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/names.h"
#include "base/steps.h"
#include "base/text.h"
#include "pipeline/compare/compare.h"
#include "pipeline/render/render_compare.h"
#include "pipeline/scene/fit_camera.h"
#include "pipeline/validate/decompose.h"
#include "pipeline/validate/split_study.h"
#include "pipeline/validate/validate_finding.h"
#include "pipeline/validate/validate_scope.h"
#include "pipeline/validate/variants.h"

#include <algorithm>

namespace rnmbake {
namespace {

using Recipe = BakingSettings::Recipe;
using Materials = SceneSettings::Materials;

// Time of a step in units of one half of a receiver bake, about.
constexpr double receiver_weight = 1, recipe_weight = 1.5, trace_weight = 0.7;
constexpr double view_weight = 3;
constexpr double study_weight = 2 * recipe_weight + trace_weight;

/// The truth with the recipe's faults up to one of them.
struct Emulation {
  const char* fault;
  TraceVariant variant;
};

/// The truth has no limit of bounces, whatever that of the bakes.
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

class ValidateRun {
 public:
  ValidateRun(Workspace& workspace, const std::vector<BasisDirection>& bases, const ValidateOptions& options)
      : workspace_(workspace),
        options_(options),
        dir_(workspace.settings().output.dir),
        exported_(with_camera(export_scene(workspace))),
        plan_(without_limit(
            plan_reference(workspace.config(), exported_.diffuse_scene.survey.blender_version))),
        scene_(exported_.diffuse_scene, plan_.blender_version),
        base_{workspace, exported_, scene_, bases},
        decomposed_(chosen(exported_, options.decompose)),
        own_(has_own_materials()),
        faults_(faults_of(blender_version_of(plan_.blender_version, "the scene"))),
        limit_(workspace.settings().bake.bounces),
        limit_matters_(bounces_matter(exported_.diffuse_scene, limit_)),
        not_followed_(not_followed(exported_.diffuse_scene)) {
    check_light(workspace.config(), exported_.diffuse_scene.survey);
    if (options.split_study) study_ = splittings(exported_);
  }

  Validation run() {
    Steps steps(step_count(), whole_weight());
    for (const BakeVariant& variant : bakes()) bake(variant, steps);
    trace(exported_.list, truth(), "tracing the truth", steps);
    if (limit_matters_)
      trace(exported_.list, limited(), fmt::format("tracing the truth with {} bounces", limit_), steps);
    for (const auto& [fault, variant] : emulations())
      trace(decomposed_, variant, fmt::format("tracing the recipe's faults up to {}", fault), steps);
    SplitStudy study;
    for (const Splitting& splitting : study_) {
      steps.begin(
          fmt::format("study: {}, {}", splitting.name, counted(splitting.list.targets.size(), "target")),
          study_weight);
      study.points.push_back(study_point(base_, splitting, plan_, 64));
    }
    std::vector<ViewComparison> views;
    if (shows_view()) {
      steps.begin("the camera's view", view_weight);
      views.push_back(view());
    }
    steps.begin("comparing", 0.1);
    Validation result = compare(study);
    for (const ViewComparison& one : views) {
      result.receiver.notes.push_back(finding_of(one));
      result.receiver.views.push_back(one);
    }
    return result;
  }

 private:
  [[nodiscard]] bool decomposes() const { return !decomposed_.targets.empty(); }
  [[nodiscard]] bool shows_view() const { return options_.view > 0; }

  [[nodiscard]] ExportResult with_camera(ExportResult exported) const {
    if (shows_view()) give_camera(exported);
    return exported;
  }

  /// The receiver's lightmaps, put back into the scene.
  [[nodiscard]] ViewComparison view() const {
    const SceneLightmaps lightmaps(halves(Recipe::receiver, Materials::lambert).first,
                                   exported_.diffuse_scene);
    ViewCompareOptions options;
    options.render = render_options(*exported_.diffuse_scene.camera, options_.view);
    options.render.view.samples = workspace_.settings().object.samples;
    options.render.view.seed = static_cast<std::uint64_t>(workspace_.settings().object.seed);
    options.render.view.threads = plan_.threads;
    options.render.bounces = plan_.bounces;
    return compare_view(workspace_, exported_, scene_, lightmaps, options);
  }

  /// Objects whose materials the lambert scene only stands in for.
  [[nodiscard]] bool has_own_materials() const {
    return std::ranges::any_of(exported_.diffuse_scene.outside, [](const OutsideModel& outside) {
      return outside.owner.starts_with("object ") && outside.what != outside.untraced;
    });
  }

  [[nodiscard]] static BakeVariant bake_of(Recipe recipe, Materials materials) {
    const bool receiver = recipe == Recipe::receiver, lambert = materials == Materials::lambert;
    std::filesystem::path folder = receiver ? "receiver" : "flat-normal-map";
    if (!lambert) folder += "-own-materials";
    return {recipe, materials, folder, (receiver ? 0 : 2) + (lambert ? 0 : 4)};
  }

  [[nodiscard]] std::vector<BakeVariant> bakes() const {
    std::vector<BakeVariant> list;
    for (const Materials materials : {Materials::lambert, Materials::full}) {
      if (materials == Materials::full && !own_) break;
      list.push_back(bake_of(Recipe::receiver, materials));
      if (decomposes()) list.push_back(bake_of(Recipe::flat_normal_map, materials));
    }
    return list;
  }

  [[nodiscard]] TraceVariant truth() const { return {plan_, "reference", 8, "tracing"}; }

  /// The truth as far as the bakes follow it: the same paths, but shorter.
  [[nodiscard]] TraceVariant limited() const {
    TraceVariant variant = truth();
    if (!limit_matters_) return variant;
    variant.plan.bounces = limit_;
    variant.folder = std::filesystem::path("emulation") / "0-bounce-limit";
    return variant;
  }

  /// The faults that this Blender has, one more each time.
  [[nodiscard]] std::vector<Emulation> emulations() const {
    std::vector<Emulation> list;
    if (!decomposes()) return list;
    TraceVariant variant = limited();
    variant.plan.flat_normal_map = true;
    int number = 0;
    for (const NamedFault& fault : all_faults()) {
      ++number;
      if (!(faults_.*fault.on)) continue;
      variant.plan.faults.*fault.on = true;
      variant.folder = std::filesystem::path("emulation") / fmt::format("{}-{}", number, fault.flag);
      ++variant.seed;
      list.push_back({fault.words, variant});
    }
    return list;
  }

  [[nodiscard]] std::size_t step_count() const {
    return 2 * bakes().size() + traces() + study_.size() + (shows_view() ? 1 : 0) + 1;
  }
  [[nodiscard]] std::size_t traces() const { return 1 + emulations().size() + (limit_matters_ ? 1 : 0); }
  [[nodiscard]] double whole_weight() const {
    double sum = 0.1 + trace_weight * double(traces()) + study_weight * double(study_.size());
    if (shows_view()) sum += view_weight;
    for (const BakeVariant& variant : bakes()) sum += 2 * weight_of(variant);
    return sum;
  }
  [[nodiscard]] static double weight_of(const BakeVariant& variant) {
    return variant.recipe == Recipe::receiver ? receiver_weight : recipe_weight;
  }

  void bake(const BakeVariant& variant, Steps& steps) {
    for (const int half : {0, 1}) {
      steps.begin(fmt::format("baking {}, half {} of 2", variant.folder.string(), half + 1),
                  weight_of(variant));
      const bool whole = variant.recipe == Recipe::receiver;
      const BakeOutcome outcome = bake_half(base_, whole ? exported_.list : decomposed_, variant, half);
      const std::size_t failed = count_failed(outcome.deliveries);
      if (failed == outcome.deliveries.size()) {
        fail(ExitCode::tasks_failed, "no object could be baked by {}; what went wrong stands above",
             variant.folder.string());
      }
      complete_ &= failed == 0;
    }
  }

  void trace(const TargetList& list, const TraceVariant& variant, const std::string& name, Steps& steps) {
    steps.begin(name, trace_weight);
    complete_ &= count_failed(trace_variant(base_, list, variant).deliveries) == 0;
  }

  [[nodiscard]] Halves halves(Recipe recipe, Materials materials) const {
    const BakeVariant variant = bake_of(recipe, materials);
    return {half_folder(base_, variant, 0), half_folder(base_, variant, 1)};
  }

  [[nodiscard]] std::filesystem::path folder_of(const TraceVariant& variant) const {
    return dir_ / variant.folder;
  }

  [[nodiscard]] Report against(const TraceVariant& traced, Recipe recipe, bool with_maps) const {
    const bool whole_recipe = recipe == Recipe::flat_normal_map && own_;
    const Halves sides = halves(recipe, whole_recipe ? Materials::full : Materials::lambert);
    CompareOptions options;
    options.candidate = {sides.first, sides.second,
                         recipe == Recipe::receiver ? "receiver" : "flat-normal-map"};
    options.reference = {folder_of(traced), {}, "reference"};
    options.with_maps = with_maps;
    Report report = compare_lightmaps(options);
    report.not_followed = not_followed_;
    if (limit_matters_) report.bounce_limit = bounce_limit(limit_, folder_of(limited()), folder_of(truth()));
    return report;
  }

  /// About the receiver as a meter: what it was told to leave out is no error of its own.
  [[nodiscard]] std::string judge(const Report& receiver) const {
    return receiver_finding(limit_matters_ ? against(limited(), Recipe::receiver, false) : receiver);
  }

  [[nodiscard]] DecomposeInput decompose_input() const {
    DecomposeInput input;
    input.truth = folder_of(truth());
    if (limit_matters_) input.emulated.push_back({"bounce limit", folder_of(limited())});
    for (const auto& [fault, variant] : emulations()) input.emulated.push_back({fault, folder_of(variant)});
    input.recipe = halves(Recipe::flat_normal_map, Materials::lambert);
    input.receiver = halves(Recipe::receiver, Materials::lambert);
    if (own_) {
      input.own_recipe = halves(Recipe::flat_normal_map, Materials::full);
      input.own_receiver = halves(Recipe::receiver, Materials::full);
    }
    return input;
  }

  [[nodiscard]] Validation compare(const SplitStudy& study) const {
    Validation result{against(truth(), Recipe::receiver, true), {}, complete_};
    Report& receiver = result.receiver;
    receiver.finding = judge(receiver);
    receiver.study = study;
    if (decomposes()) {
      receiver.decompositions = decompose(decompose_input());
      const std::string of_recipe = recipe_finding(receiver.decompositions.front(), not_followed_);
      receiver.finding += "; " + of_recipe;
      result.recipe = against(truth(), Recipe::flat_normal_map, true);
      result.recipe->finding = of_recipe + ".";
      result.recipe->decompositions = receiver.decompositions;
      result.recipe->study = study;
      add_notes(*result.recipe);
    }
    receiver.finding += ".";
    add_notes(receiver);
    return result;
  }

  void add_notes(Report& report) const {
    report.settings.emplace_back("materials",
                                 own_ ? "lambert; own materials too, for the rows that are about them"
                                      : "lambert, which is what the scene's own are");
    if (decomposed_.targets.size() < exported_.list.targets.size()) {
      report.notes.push_back(fmt::format("The published recipe baked {} of {} targets (--decompose).",
                                         decomposed_.targets.size(), exported_.list.targets.size()));
    }
    if (decomposes())
      report.notes.emplace_back(
          "The decomposition is of flat-normal-map minus the reference. Causes are added to the tracer one "
          "after "
          "the other; 'residual' is Cycles' bake minus the tracer with all of them.");
    for (std::string& note : scope_notes(exported_.diffuse_scene)) report.notes.push_back(std::move(note));
  }

  Workspace& workspace_;
  ValidateOptions options_;
  std::filesystem::path dir_;
  ExportResult exported_;
  ReferencePlan plan_;
  TraceScene scene_;
  VariantBase base_;
  TargetList decomposed_;
  bool own_;
  RecipeFaults faults_;
  int limit_;           // bounces that the bakes follow
  bool limit_matters_;  // so that it is traced, too
  std::vector<std::string> not_followed_;
  std::vector<Splitting> study_;
  bool complete_ = true;
};

}  // namespace

Validation validate(Workspace& workspace, const std::vector<BasisDirection>& bases,
                    const ValidateOptions& options) {
  return ValidateRun(workspace, bases, options).run();
}

}  // namespace rnmbake
