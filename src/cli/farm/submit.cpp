#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bases/basis_file.h"
#include "cli/farm/farm.h"
#include "cli/farm/merge_arguments.h"
#include "cli/farm/queue.h"
#include "cli/flags/command_line.h"
#include "cli/flags/settings_flags.h"
#include "pipeline/farm/cut_tasks.h"
#include "pipeline/farm/export_flamenco.h"
#include "pipeline/farm/export_openjd.h"
#include "pipeline/farm/make_plan.h"
#include "pipeline/farm/queue_words.h"
#include "pipeline/lightmaps/deliver_lightmap.h"
#include "pipeline/run/result_store.h"
#include "pipeline/scene/scene_key.h"
#include "process/stop.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

struct SubmitFlags {
  fs::path plan;
  double task_minutes = 15;
  QueueFlags queue;
  std::string exported;  // "openjd", "flamenco"; "": for no other queue
};

fs::path plan_folder(const ResolvedConfig& config, const SubmitFlags& flags) {
  return flags.plan.empty() ? usual_plan_folder(config.globals.output.dir) : flags.plan;
}

FarmPlan make_plan(ResolvedConfig config, const SubmitFlags& flags, std::vector<std::string> merge) {
  require_farmable(config);
  settle_layout(config.globals);
  const OutputSettings& output = config.globals.output;
  const std::vector<BasisDirection> bases = choose_bases(config.globals.bake);
  LateBlender blender(config.globals);
  (void)blender.info();  // throws where Blender is missing, before any file is written
  const FolderLock lock = prepare_output(output, config.globals.run);
  FarmOptions options{plan_folder(config, flags), flags.task_minutes * 60, std::move(merge)};
  prepare_plan_folder(options.folder);
  BlenderSession session(config, blender, options.folder);
  const SurveyResult scene = survey_scene(session);
  check_light(config, scene.survey);
  const TargetList list = make_targets(config, scene.survey);
  EarlierLightmaps earlier = find_earlier(session, {"bake", bases}, scene.survey, list.targets);
  Store store = open_store(config.globals);
  const DispatchRules rules{{store, scene_key(session, scene.survey)}, {}};
  const BakeSubject subject{scene.survey, list, bases, scene.blends, std::move(earlier), rules};
  return make_farm_plan(session, subject, store, options);
}

void export_plan(const FarmPlan& plan, const std::string& queue) {
  const fs::path job = queue == "openjd" ? export_openjd(plan) : export_flamenco(plan);
  std::cout << "# tasks and merge as one job of a queue (docs/farm.md):\n"
            << shell_word(job.string()) << "\n";
}

void say_what_next(const FarmPlan& plan) {
  const std::string folder = shell_word(plan.folder.string());
  if (!plan.tasks.empty()) {
    std::cout << "# run each task once, anywhere, in any order:\n";
    std::cout << fmt::format("rnmbake task run --plan {} --index N    # N = 0 to {}\n", folder,
                             plan.tasks.size() - 1);
    std::cout << fmt::format("seq 0 {} | parallel rnmbake task run --plan {} --index {{}}\n",
                             plan.tasks.size() - 1, folder);
    std::cout << "# how far it is:\n";
    std::cout << fmt::format("rnmbake status {}\n", folder);
  }
  std::cout << "# then, once, in this folder:\n" << merge_command(plan) << "\n";
}

int submit(const ResolvedConfig& config, const SubmitFlags& flags, std::vector<std::string> merge) {
  flags.queue.require(plan_folder(config, flags));  // before anything is planned
  if (!flags.exported.empty()) require_queue_words(fs::absolute(plan_folder(config, flags)));
  const FarmPlan plan = make_plan(config, flags, std::move(merge));
  double all = 0, longest = 0;
  for (const FarmTask& task : plan.tasks) {
    all += task.seconds;
    longest = std::max(longest, task.seconds);
  }
  log::info("{} of about {} on two cores, the longest {} ({:.0f} % over the mean); {}",
            counted(plan.tasks.size(), "task"),
            spoken_duration(plan.tasks.empty() ? 0 : all / double(plan.tasks.size())),
            spoken_duration(longest), 100 * (imbalance(plan.tasks) - 1), plan.folder.string());
  if (!flags.exported.empty()) export_plan(plan, flags.exported);
  if (!flags.queue.submit(plan)) say_what_next(plan);
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_submit_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("submit", "Cut a bake into tasks for many machines");
  auto settings = std::make_shared<SettingsFlags>(*command);
  auto flags = std::make_shared<SubmitFlags>();
  command->add_option("--plan", flags->plan, "folder of the plan; DIR/.rnmbake-plan unless given")
      ->type_name("PATH");
  command->add_option("--task-minutes", flags->task_minutes, "length of a task, on two cores")
      ->type_name("X")
      ->check(CLI::Range(0.01, 1e5).description(""))
      ->capture_default_str();
  flags->queue.add_to(*command);
  command->add_option("--export", flags->exported, "write the plan down as a job for another queue, too")
      ->type_name("openjd|flamenco")
      ->check(CLI::IsMember({"openjd", "flamenco"}).description(""));
  return [settings, flags] {
    const auto config = settings->resolve();
    if (!config) return static_cast<int>(ExitCode::ok);
    StopRequest::install();
    return submit(*config, *flags, merge_arguments(*config, settings->scene_argument()));
  };
}

}  // namespace rnmbake
