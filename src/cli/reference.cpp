#include "cli/reference.h"

#include "base/error.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bases/basis_file.h"
#include "cli/flags/settings_flags.h"
#include "cli/rerun.h"
#include "cli/run_report.h"
#include "jobs/run_index.h"
#include "pipeline/reference/reference_run.h"
#include "pipeline/run/result_store.h"
#include "pipeline/scene/export_scene.h"
#include "pipeline/scene/save_scene.h"
#include "process/stop.h"

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

int report(const ReferenceOutcome& outcome, const OutputSettings& output) {
  const std::size_t total = outcome.deliveries.size();
  if (const std::size_t failed = count_failed(outcome.deliveries); failed > 0) {
    log::warn("{} of {} failed; what was finished is in {}", failed, counted(total, "object"),
              output.dir.string());
    return static_cast<int>(ExitCode::tasks_failed);
  }
  log::info("{} in {}, {:.1f} s, {:.2f} million rays a second", counted(total, "lightmap"),
            output.dir.string(), outcome.wall_seconds,
            outcome.wall_seconds > 0 ? double(outcome.rays) / outcome.wall_seconds / 1e6 : 0.0);
  return static_cast<int>(ExitCode::ok);
}

std::string in_words(const std::vector<std::string>& what) {
  return fmt::format("{}", fmt::join(what, ", "));
}

void say_what_is_left_out(const DiffuseScene& scene) {
  for (const OutsideModel& outside : scene.outside)
    log::warn("{}: outside the reference's model: {}", outside.owner, in_words(outside.what));
}

/// One line for a bake. `materials`: what was asked for; in a lambert scene there is less to leave out.
void say_what_is_not_followed(const DiffuseScene& scene, SceneSettings::Materials materials) {
  std::vector<std::string> owners;
  for (const OutsideModel& outside : scene.outside) {
    const bool lambert = materials == SceneSettings::Materials::lambert;
    const std::vector<std::string>& what = lambert ? outside.untraced : outside.what;
    if (!what.empty()) owners.push_back(fmt::format("{} ({})", outside.owner, in_words(what)));
  }
  if (owners.empty()) return;
  log::warn(
      "{}: the embree engine does not follow what stands in brackets, only light between diffuse surfaces; "
      "manifest.json lists all of it{}",
      first_names(owners),
      materials == SceneSettings::Materials::lambert ? "" : ", and engine cycles follows it");
}

/// What distinguishes a reference from a bake by the tracer.
struct TracedKind {
  const char* name;  // in manifests
  ReferencePlan (*plan)(const ResolvedConfig&, const std::string& scene_version);
  const char* verb;
};

int trace(const ResolvedConfig& config, const TracedKind& kind, const BetweenTraceSteps& between,
          RunReport& made) {
  const BakeSettings& settings = config.globals;
  const std::vector<BasisDirection> bases = choose_bases(settings.bake);
  LateBlender blender(settings);
  if (!is_rnmscene(settings.scene.file))
    (void)blender.info();          // throws where it is missing, before any file is written
  (void)kind.plan(config, "5.0");  // throws for settings that are invalid in every version
  BlenderSession session(config, blender);
  std::optional<FolderLock> lock;
  if (!between.preview) lock.emplace(prepare_output(settings.output, settings.run));
  const ExportResult exported = export_scene(session, between.anew);
  const SceneSurvey& survey = exported.diffuse_scene.survey;
  if (between.surveyed) between.surveyed(survey);
  check_light(config, survey);
  const ReferencePlan plan = kind.plan(config, survey.blender_version);
  if (plan.is_bake)
    say_what_is_not_followed(exported.diffuse_scene, settings.scene.materials);
  else
    say_what_is_left_out(exported.diffuse_scene);
  if (between.preview) return between.preview(survey, exported.list);
  const FindEarlier find = [&](const std::vector<Target>& targets) {
    return find_earlier(session, {kind.name, bases}, survey, targets);
  };
  const LocalTargets chosen = between.choose ? between.choose(survey, exported.list, find)
                                             : LocalTargets{exported.list, find(exported.list.targets)};
  int code = static_cast<int>(ExitCode::ok);
  if (chosen.list.targets.empty()) {
    keep_all(settings.output.dir, survey, chosen.earlier);
  } else {
    const TraceScene scene(exported.diffuse_scene, plan.blender_version);
    SavedScene saved;
    if (exported.blends) {
      saved = save_scene_with_uvs(session, survey, exported.blends->own,
                                  chosen.earlier.add_to(uvs_of(chosen.list.targets)));
    }
    log::info("{} {} x {} against Blender {}", kind.verb, counted(chosen.list.targets.size(), "lightmap"),
              counted(bases.size(), "direction"), plan.blender_version);
    Store store = open_store(settings);
    const ReferenceSubject subject{
        scene, chosen.list, bases, chosen.earlier, {&store, exported.content, between.anew}};
    code = report(run_reference(subject, settings, plan, kind.verb, saved), settings.output);
  }
  if (between.delivered && code == static_cast<int>(ExitCode::ok)) between.delivered(survey, chosen);
  made = made_from(config);
  add_scene_inputs(survey.inputs, made);
  add_lightmaps(made);
  return code;
}

}  // namespace

int trace_reference(const ResolvedConfig& config, const RerunFlags& flags, RunReport& made) {
  const BakeSettings& settings = config.globals;
  if (settings.output.dir.empty()) (void)prepare_output(settings.output, settings.run);  // throws
  const LastRun last(config, "reference", {!is_rnmscene(settings.scene.file)});
  if (last.reasons().empty() && !flags.force) {
    report_last_run(config, last, made);
    add_lightmaps(made);
    return static_cast<int>(ExitCode::ok);
  }
  say_why(last.reasons(), flags.why);
  BetweenTraceSteps between;
  between.anew = flags.force;
  between.surveyed = [&](const SceneSurvey& survey) {
    say_why(last.scene_changes(survey.digest), flags.why);
  };
  between.delivered = [&](const SceneSurvey& survey, const LocalTargets&) {
    last.keep(survey.inputs, place_scene(survey), lightmap_files(settings.output.dir));
  };
  return trace(config, {"reference", plan_reference, "tracing"}, between, made);
}

int trace_bake(const ResolvedConfig& config, const BetweenTraceSteps& between, RunReport& made) {
  return trace(config, {"bake", plan_traced_bake, "baking"}, between, made);
}

std::function<int()> add_reference_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "reference", "Trace what the lightmaps of a scene should hold, with standard errors");
  auto flags = std::make_shared<SettingsFlags>(*command, Purpose::reference);
  auto rerun = std::make_shared<RerunFlags>();
  add_rerun_flags(*command, *rerun);
  auto run = std::make_shared<RunFlags>(*command);
  return [flags, rerun, run] {
    return run->run([&](RunReport& made) {
      const auto config = flags->resolve();
      if (!config) return static_cast<int>(ExitCode::ok);
      StopRequest::install();
      const int code = trace_reference(*config, *rerun, made);
      if (code == static_cast<int>(ExitCode::ok))
        remember_run({LastRun::record_in(config->globals.output.dir)});
      return code;
    });
  };
}

}  // namespace rnmbake
