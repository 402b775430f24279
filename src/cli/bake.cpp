#include "cli/bake.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/progress.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bake_several.h"
#include "cli/bases/basis_file.h"
#include "cli/flags/settings_flags.h"
#include "cli/reference.h"
#include "cli/rerun.h"
#include "cli/run_report.h"
#include "jobs/run_index.h"
#include "pipeline/bake/bake_run.h"
#include "pipeline/farm/shared_folders.h"
#include "pipeline/farm/task_result.h"
#include "pipeline/lightmaps/left_files.h"
#include "pipeline/local/local_targets.h"
#include "pipeline/reference/reference_plan.h"
#include "pipeline/run/hold_folder.h"
#include "pipeline/run/result_store.h"
#include "pipeline/scene/export_scene.h"
#include "pipeline/scene/scene_key.h"
#include "pipeline/scene/scene_survey.h"
#include "process/stop.h"

#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

int report(const BakeOutcome& outcome, const OutputSettings& output) {
  const std::size_t total = outcome.deliveries.size();
  if (const std::size_t failed = count_failed(outcome.deliveries); failed > 0) {
    // A warning: each of them had its error already.
    log::warn("{} of {} failed; what was finished is in {}", failed, counted(total, "object"),
              output.dir.string());
    return static_cast<int>(ExitCode::tasks_failed);
  }
  log::info("{} in {}, {:.1f} s", counted(total, "lightmap"), output.dir.string(),
            outcome.timings.wall_seconds);
  return static_cast<int>(ExitCode::ok);
}

/// The moment on the clock at which --time is over.
std::optional<double> deadline_of(const RunSettings& run, double started) {
  const auto seconds = parse_duration(run.time);
  return seconds ? std::optional(started + *seconds) : std::nullopt;
}

struct BakeFlags {
  bool why = false, dry_run = false, force = false, prune = false, preview = false;
  std::optional<double> assume_local;  // how far from changes, scene units
  std::filesystem::path merge;         // plan of rnmbake submit; "": bake
};

int show_plan(const std::vector<BakePreview>& targets) {
  for (const BakePreview& one : targets)
    std::cout << printable(one.key)
              << (one.is_kept ? ": baked before" : fmt::format(": {} samples to bake", one.samples)) << "\n";
  return static_cast<int>(ExitCode::ok);
}

void say_assumed(const LocalTargets& local) {
  if (local.assumed > 0)
    log::info("{} assumed to be as before; a bake without --assume-local makes sure",
              counted(local.assumed, "lightmap"));
}

bool is_traced(const BakeSettings& settings) {
  return settings.bake.engine == BakingSettings::Engine::embree;
}

/// With engine embree.
int bake_by_embree(const ResolvedConfig& config, const BakeFlags& flags, const LastRun& last,
                   RunReport& made) {
  const LocalRule rule(flags.assume_local, last, config.globals.output.dir);
  BetweenTraceSteps between;
  between.anew = flags.force;
  between.surveyed = [&](const SceneSurvey& survey) {
    say_why(last.scene_changes(survey.digest), flags.why);
  };
  between.choose = [&](const SceneSurvey& survey, const TargetList& all, const FindEarlier& find) {
    return rule.choose(survey, all, find);
  };
  between.delivered = [&](const SceneSurvey& survey, const LocalTargets& local) {
    last.keep(survey.inputs, place_scene(survey), lightmap_files(config.globals.output.dir), local.assumed);
    say_assumed(local);
  };
  if (flags.dry_run) {
    between.preview = [&](const SceneSurvey& survey, const TargetList& targets) {
      const TargetList list = rule.preview(survey, targets);
      std::vector<BakePreview> all;
      for (std::size_t i = 0; i < list.targets.size(); ++i)
        all.push_back({list.targets[i].key, false, list.settings[i].samples});
      return show_plan(all);
    };
  }
  return trace_bake(config, between, made);
}

/// The plan whose passes are merged, with its cache and atlases for the settings.
std::optional<FarmPlan> plan_to_merge(const BakeFlags& flags, BakeSettings& settings) {
  if (flags.merge.empty()) return std::nullopt;
  FarmPlan plan = read_farm_plan(flags.merge);
  settings.run.cache = plan.settings.at("cache").get<std::string>();
  settings.run.jobs = plan.settings.at("jobs").get<int>();
  settings.bake.memory_limit = plan.settings.at("memory_limit").get<int>();
  return plan;
}

/// Says of each target why passes of it are missing.
std::function<std::string(std::size_t)> reasons_of(const std::optional<FarmPlan>& plan,
                                                   const std::vector<Target>& targets) {
  if (!plan) return {};
  return [&targets, &plan, results = read_task_results(*plan)](std::size_t target) {
    return why_missing(*plan, results, targets[target].key);
  };
}

int bake_or_merge(ResolvedConfig config, const BakeFlags& flags, const std::optional<FarmPlan>& plan,
                  RunReport& made) {
  const double started = steady_clock().now();
  const bool traced = is_traced(config.globals);
  if (traced) (void)plan_traced_bake(config, "5.0");  // throws for what only Cycles does
  const OutputSettings& output = config.globals.output;
  if (output.dir.empty()) (void)prepare_output(output, config.globals.run);  // throws
  const LastRun last(config, "bake",
                     {!traced || !is_rnmscene(config.globals.scene.file), !flags.assume_local});
  if (last.reasons().empty() && !flags.force && !plan) {
    report_last_run(config, last, made);
    add_lightmaps(made);
    return static_cast<int>(ExitCode::ok);
  }
  say_why(last.reasons(), flags.why);
  if (traced) return bake_by_embree(config, flags, last, made);
  const std::vector<BasisDirection> bases = choose_bases(config.globals.bake);
  LateBlender blender(config.globals);
  (void)blender.info();  // throws where Blender is missing, before any file is written
  BlenderSession session(config, blender);
  std::optional<FolderLock> lock;
  if (!flags.dry_run) lock.emplace(prepare_output(output, config.globals.run));
  const SurveyResult scene = survey_scene(session);
  say_why(last.scene_changes(scene.survey.digest), flags.why);
  check_light(config, scene.survey);
  const FindEarlier find = [&](const std::vector<Target>& targets) {
    return find_earlier(session, {"bake", bases}, scene.survey, targets);
  };
  LocalTargets local = LocalRule(flags.assume_local, last, output.dir)
                           .choose(scene.survey, make_targets(config, scene.survey), find);
  Store store = open_store(config.globals);
  const DispatchRules rules{{store, scene_key(session, scene.survey)},
                            deadline_of(config.globals.run, started),
                            {},
                            reasons_of(plan, local.list.targets),
                            flags.preview};
  const BakeSubject subject{scene.survey, local.list, bases, scene.blends, local.earlier, rules};
  if (flags.dry_run) return show_plan(preview_bake(session, subject));
  int code = static_cast<int>(ExitCode::ok);
  if (local.list.targets.empty())
    keep_all(output.dir, scene.survey, local.earlier);
  else
    code = report(run_bake(session, subject), output);
  if (code == static_cast<int>(ExitCode::ok))
    last.keep(scene.survey.inputs, place_scene(scene.survey), lightmap_files(output.dir), local.assumed);
  say_assumed(local);
  made = made_from(config);
  add_scene_inputs(scene.survey.inputs, made);
  add_lightmaps(made);
  return code;
}

int bake(ResolvedConfig config, const BakeFlags& flags, RunReport& made) {
  const std::optional<FarmPlan> plan = plan_to_merge(flags, config.globals);
  if (!plan || flags.dry_run) return bake_or_merge(std::move(config), flags, plan, made);
  try {
    const int code = bake_or_merge(std::move(config), flags, plan, made);
    note_merged(*plan, {code, ""});
    if (code == static_cast<int>(ExitCode::ok)) remove_token(*plan);
    return code;
  } catch (const Error& error) {
    note_merged(*plan, {static_cast<int>(error.code()), error.what()});
    throw;
  }
}

/// Deletes what no lightmap of the folder is any more.
void prune(const BakeSettings& settings) {
  const std::filesystem::path& dir = settings.output.dir;
  const FolderLock lock = hold_folder(dir, settings.run.lock_wait);
  const Pruned pruned = prune_left_files(dir);
  if (!pruned.removed.empty())
    log::info("{}: {} deleted ({}): no lightmap of the scene any more", dir.string(),
              counted(pruned.removed.size(), "file"), first_names(pruned.removed));
  if (!pruned.changed.empty())
    log::warn("{}: {}: changed since baked, so kept; delete by hand what is not wanted", dir.string(),
              first_names(pruned.changed));
}

int bake_and_prune(const ResolvedConfig& config, const BakeFlags& flags, RunReport& made) {
  const int code = bake(config, flags, made);
  if (flags.prune && !flags.dry_run) prune(config.globals);
  return code;
}

int bake_all(const std::vector<ResolvedConfig>& configs, const BakeFlags& flags, RunReport& made) {
  const BakeOne one = [&](const ResolvedConfig& config, RunReport& report) {
    return bake_and_prune(config, flags, report);
  };
  const int code =
      configs.size() == 1 ? one(configs.front(), made) : bake_several(configs, one, flags.dry_run, made);
  if (code != 0 || flags.dry_run) return code;
  std::vector<std::filesystem::path> records;
  for (const ResolvedConfig& config : configs)
    records.push_back(LastRun::record_in(config.globals.output.dir));
  remember_run(records);
  return code;
}

}  // namespace

int bake_scene(ResolvedConfig config, RunReport& made) {
  return bake(std::move(config), {}, made);
}

std::function<int()> add_bake_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bake", "Bake a scene into directional lightmaps");
  auto flags = std::make_shared<SettingsFlags>(*command);
  flags->take_several_scenes(*command);
  auto more = std::make_shared<BakeFlags>();
  command->add_flag("--why", more->why, "list all that made the bake necessary");
  command->add_flag("--dry-run", more->dry_run, "say what would be baked, and bake nothing");
  command->add_flag("--force", more->force, "look for changes in the scene even where no file changed");
  command->add_flag("--prune", more->prune,
                    "delete the files of earlier lightmaps whose objects left the scene (docs/bake.md)");
  command->add_flag("--preview", more->preview,
                    "show each lightmap in DIR/preview after its first pass, until it is there");
  command
      ->add_option("--assume-local", more->assume_local,
                   "bake again only what lies within so many scene units of a change (docs/bake.md)")
      ->type_name("X")
      ->check(CLI::Range(0.0, 1e9).description(""));
  command
      ->add_option("--merge", more->merge,
                   "bake nothing: merge what the tasks of this plan (rnmbake submit) baked")
      ->type_name("PLAN");
  auto run = std::make_shared<RunFlags>(*command);
  return [flags, more, run] {
    return run->run([&](RunReport& made) {
      const std::vector<ResolvedConfig> configs = flags->resolve_all();
      if (configs.empty()) return static_cast<int>(ExitCode::ok);
      if (configs.size() > 1 && run->wants_depfile())
        fail(ExitCode::usage,
             "--depfile names the inputs of one scene, and here are {}; bake each by a call of its own",
             configs.size());
      if (configs.size() > 1 && !more->merge.empty())
        fail(ExitCode::usage, "--merge is of one scene, and here are {}; name that of the plan",
             configs.size());
      StopRequest::install();
      return bake_all(configs, *more, made);
    });
  };
}

}  // namespace rnmbake
