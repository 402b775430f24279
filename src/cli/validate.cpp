#include "cli/validate.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bases/basis_file.h"
#include "cli/flags/command_line.h"
#include "cli/flags/settings_flags.h"
#include "cli/run_report.h"
#include "config/recipe_names.h"
#include "pipeline/lightmaps/deliver_lightmap.h"
#include "pipeline/validate/validate_run.h"
#include "process/stop.h"
#include "report/thresholds.h"
#include "report/write.h"

#include <iostream>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

struct ValidateFlags {
  explicit ValidateFlags(CLI::App& command) : settings(command, Purpose::validate), run(command) {
    command
        .add_option("--study", study,
                    "split: also bake objects whole, by material, by loose part and by grid, for error and "
                    "time against the number of targets")
        ->check(CLI::IsMember({"split"}).description(""))
        ->type_name("split");
    command
        .add_option("--decompose", decompose,
                    "objects that the published recipe bakes too, so that its error can be taken apart; it "
                    "costs most of the time of a large scene. * and ? are wildcards; none: none [*]")
        ->delimiter(',')
        ->type_name("A,B,...");
    command
        .add_option("--view", view,
                    "longer side of the camera's view in the report, in pixels: traced, by Cycles, and lit "
                    "by the lightmaps in each way to decode them; 0: none [480]")
        ->check(CLI::Range(0, 4096).description(""))
        ->type_name("N");
    command
        .add_option("--probes", probes,
                    "light probes in a box around the scene, about so many, by Blender and by the reference: "
                    "whether both agree; 0: none [0]")
        ->check(CLI::Range(0, 1000000).description(""))
        ->type_name("N");
    command
        .add_option(
            "--fail-above", fail_above,
            "limits for each object and basis of the receiver's bake, such as rmse=2%,bias=0.5%: exit "
            "code 7 where one is exceeded. Of rmse, bias, p95, p99, max; % is of the reference's mean")
        ->type_name("LIMITS");
  }
  SettingsFlags settings;
  RunFlags run;
  std::string study, fail_above;
  std::vector<std::string> decompose = ValidateOptions{}.decompose;
  int view = ValidateOptions{}.view, probes = ValidateOptions{}.probes;
};

std::string command_of(const ResolvedConfig& config, const ValidateFlags& flags) {
  std::string line = command_line("validate", config);
  if (!flags.study.empty()) line += " --study " + shell_word(flags.study);
  if (flags.decompose != ValidateOptions{}.decompose)
    line += " --decompose " + shell_word(fmt::format("{}", fmt::join(flags.decompose, ",")));
  if (flags.view != ValidateOptions{}.view) line += fmt::format(" --view {}", flags.view);
  if (flags.probes > 0) line += fmt::format(" --probes {}", flags.probes);
  if (!flags.fail_above.empty()) line += " --fail-above " + shell_word(flags.fail_above);
  return line;
}

/// Titles, command, limits; then both pages.
ThresholdOutcome write_reports(Validation& found, const ResolvedConfig& config, const ValidateFlags& flags,
                               std::vector<Threshold> thresholds) {
  const std::filesystem::path dir = config.globals.output.dir;
  const std::string scene = config.globals.scene.file.filename().string();
  found.receiver.title = scene + ": receiver against the reference";
  found.receiver.command = command_of(config, flags);
  found.receiver.thresholds = check_thresholds(found.receiver, std::move(thresholds));
  if (found.recipe) {
    found.recipe->title = scene + ": flat-normal-map against the reference";
    found.recipe->command = found.receiver.command;
    found.receiver.notes.emplace_back("The same for flat-normal-map: flat-normal-map/report.html");
    write_report(*found.recipe, dir / flat_normal_map_name);
  }
  write_report(found.receiver, dir);
  return found.receiver.thresholds;
}

/// Names of the pages, the finding, and limits that were exceeded.
RunReport report_of(const ResolvedConfig& config, const Validation& found, const ThresholdOutcome& limits) {
  RunReport made = made_from(config);
  add_scene_inputs(found.inputs, made);
  made.main_file = made.output / "report.json";
  made.files = {"report.html", "report.csv", "report.json"};
  if (found.recipe) {
    for (const char* name : {"report.html", "report.csv", "report.json"})
      made.files.push_back(std::string(flat_normal_map_name) + "/" + name);
  }
  made.more["finding"] = found.receiver.finding;
  made.more["complete"] = found.complete;
  made.more["exceeded"] = describe(limits);
  return made;
}

int validate(const ResolvedConfig& config, const ValidateFlags& flags, RunReport& made) {
  std::vector<Threshold> thresholds;
  if (!flags.fail_above.empty()) thresholds = parse_thresholds(flags.fail_above);
  const std::vector<BasisDirection> bases = choose_bases(config.globals.bake);
  LateBlender blender(config.globals);
  (void)blender.info();  // throws where Blender is missing, before any file is written
  BlenderSession session(config, blender);
  const FolderLock lock = prepare_output(config.globals.output, config.globals.run);
  Validation found =
      validate(session, bases, {flags.decompose, flags.study == "split", flags.view, flags.probes});
  const ThresholdOutcome limits = write_reports(found, config, flags, std::move(thresholds));
  made = report_of(config, found, limits);
  if (!flags.run.json()) std::cout << printable(found.receiver.finding) << '\n';
  log::info("report: {}", (config.globals.output.dir / "report.html").string());
  for (const std::string& line : describe(limits)) log::error("{}", line);
  if (!limits.exceeded.empty()) return static_cast<int>(ExitCode::threshold_exceeded);
  return static_cast<int>(found.complete ? ExitCode::ok : ExitCode::tasks_failed);
}

}  // namespace

std::function<int()> add_validate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("validate", "Say how wrong the bake of a scene is, and why");
  auto flags = std::make_shared<ValidateFlags>(*command);
  return [flags] {
    return flags->run.run([&](RunReport& made) {
      const auto config = flags->settings.resolve();
      if (!config) return static_cast<int>(ExitCode::ok);
      StopRequest::install();
      return validate(*config, *flags, made);
    });
  };
}

}  // namespace rnmbake
