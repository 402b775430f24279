#include "cli/validate.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bases/basis_file.h"
#include "cli/flags/command_line.h"
#include "cli/flags/settings_flags.h"
#include "cli/rerun.h"
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
    add_rerun_flags(command, rerun);
  }
  SettingsFlags settings;
  RunFlags run;
  RerunFlags rerun;
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

/// Says the finding; adds it, the names of the pages, and limits that were exceeded.
void conclude(const std::string& finding, bool complete, const std::vector<std::string>& exceeded,
              const ValidateFlags& flags, RunReport& made) {
  made.main_file = made.output / "report.json";
  made.files = {"report.html", "report.csv", "report.json"};
  if (flags.decompose != std::vector<std::string>{"none"}) {
    for (const char* name : {"report.html", "report.csv", "report.json"})
      made.files.push_back(std::string(flat_normal_map_name) + "/" + name);
  }
  made.more["finding"] = finding;
  made.more["complete"] = complete;
  made.more["exceeded"] = exceeded;
  if (!flags.run.json()) std::cout << printable(finding) << '\n';
}

/// What decides the result beside settings, a line each.
std::string own_settings(const ValidateFlags& flags) {
  return fmt::format("validate\nstudy = {}\ndecompose = {}\nview = {}\nprobes = {}\nfail-above = {}",
                     flags.study, fmt::join(flags.decompose, ","), flags.view, flags.probes,
                     flags.fail_above);
}

/// Reports, and what all steps wrote: nothing else that the folder may hold.
std::vector<RunFile> files_in(const std::filesystem::path& output) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(output);
  std::vector<RunFile> files;
  const auto add = [&](const fs::path& file) {
    const bool is_hidden = file.filename().string().starts_with('.');  // lock and records
    if (fs::is_regular_file(file) && !is_hidden) files.push_back(look_at("output", file));
  };
  for (const char* report : {"report.html", "report.csv", "report.json"}) add(folder / report);
  for (const char* step : {"receiver", "receiver-own-materials", "flat-normal-map",
                           "flat-normal-map-own-materials", "reference", "emulation", "study", "probes"}) {
    if (!fs::is_directory(folder / step)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder / step)) add(entry.path());
  }
  return files;
}

/// All that the last run said, once more.
void repeat(const ResolvedConfig& config, const ValidateFlags& flags, const LastRun& last, RunReport& made) {
  report_last_run(config, last, made);
  const std::filesystem::path report = config.globals.output.dir / "report.json";
  const nlohmann::json text = parse_json(read_text(report), report.string());
  conclude(text.at("finding").get<std::string>(), true, {}, flags, made);
}

int validate(const ResolvedConfig& config, const ValidateFlags& flags, RunReport& made) {
  std::vector<Threshold> thresholds;
  if (!flags.fail_above.empty()) thresholds = parse_thresholds(flags.fail_above);
  const std::vector<BasisDirection> bases = choose_bases(config.globals.bake);
  const OutputSettings& output = config.globals.output;
  if (output.dir.empty()) (void)prepare_output(output, config.globals.run);  // throws
  const LastRun last(config, own_settings(flags), {});
  if (last.reasons().empty() && !flags.rerun.force) {
    repeat(config, flags, last, made);
    return static_cast<int>(ExitCode::ok);
  }
  say_why(last.reasons(), flags.rerun.why);
  LateBlender blender(config.globals);
  (void)blender.info();  // throws where Blender is missing, before any file is written
  BlenderSession session(config, blender);
  const FolderLock lock = prepare_output(output, config.globals.run);
  Validation found = validate(
      session, bases, {flags.decompose, flags.study == "split", flags.view, flags.probes, flags.rerun.force});
  const ThresholdOutcome limits = write_reports(found, config, flags, std::move(thresholds));
  made = made_from(config);
  add_scene_inputs(found.inputs, made);
  conclude(found.receiver.finding, found.complete, describe(limits), flags, made);
  log::info("report: {}", (output.dir / "report.html").string());
  for (const std::string& line : describe(limits)) log::error("{}", line);
  if (!limits.exceeded.empty()) return static_cast<int>(ExitCode::threshold_exceeded);
  if (!found.complete) return static_cast<int>(ExitCode::tasks_failed);
  last.keep(found.inputs, {found.digest, {}, {}}, files_in(output.dir));
  return static_cast<int>(ExitCode::ok);
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
