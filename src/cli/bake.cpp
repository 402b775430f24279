#include "cli/bake.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bases/basis_file.h"
#include "cli/settings_flags.h"
#include "pipeline/bake/bake_run.h"
#include "pipeline/scene/scene_key.h"
#include "pipeline/scene/scene_survey.h"
#include "process/stop.h"

#include <memory>
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

int bake(const ResolvedConfig& config) {
  const double started = steady_clock().now();
  const std::vector<BasisDirection> bases = choose_bases(config.globals.bake);
  LateBlender blender(config.globals);
  (void)blender.info();  // throws where Blender is missing, before any file is written
  BlenderSession session(config, blender);
  prepare_output(config.globals.output);
  const SurveyResult scene = survey_scene(session);
  check_light(config, scene.survey);
  const TargetList list = make_targets(config, scene.survey);
  EarlierLightmaps earlier = find_earlier(session, {"bake", bases}, scene.survey, list.targets);
  Store store("", 0);
  const DispatchRules rules{{store, scene_key(session, scene.survey)},
                            deadline_of(config.globals.run, started)};
  return report(run_bake(session, {scene.survey, list, bases, scene.blends, std::move(earlier), rules}),
                config.globals.output);
}

}  // namespace

std::function<int()> add_bake_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bake", "Bake a scene into directional lightmaps");
  auto flags = std::make_shared<SettingsFlags>(*command);
  return [flags] {
    const auto config = flags->resolve();
    if (!config) return static_cast<int>(ExitCode::ok);
    StopRequest::install();
    return bake(*config);
  };
}

}  // namespace rnmbake
