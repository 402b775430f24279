#include "cli/reference.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bases/basis_file.h"
#include "cli/settings_flags.h"
#include "pipeline/reference/reference_run.h"
#include "pipeline/scene/export_scene.h"
#include "pipeline/scene/save_scene.h"
#include "process/stop.h"

#include <memory>

#include <CLI/CLI.hpp>

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

void say_what_is_left_out(const DiffuseScene& scene) {
  for (const OutsideModel& outside : scene.outside) {
    std::string what;
    for (const std::string& one : outside.what) what += (what.empty() ? "" : ", ") + one;
    log::warn("{}: outside the reference's model: {}", outside.owner, what);
  }
}

}  // namespace

int trace_reference(const ResolvedConfig& config) {
  const BakeSettings& settings = config.globals;
  const std::vector<BasisDirection> bases = choose_bases(settings.bake);
  LateBlender blender(settings);
  if (!is_rnmscene(settings.scene.file))
    (void)blender.info();               // throws where it is missing, before any file is written
  (void)plan_reference(config, "5.0");  // throws for settings that are invalid in every version
  BlenderSession session(config, blender);
  const FolderLock lock = prepare_output(settings.output, settings.run);
  const ExportResult exported = export_scene(session);
  const SceneSurvey& survey = exported.diffuse_scene.survey;
  check_light(config, survey);
  say_what_is_left_out(exported.diffuse_scene);
  const ReferencePlan plan = plan_reference(config, survey.blender_version);
  const TraceScene scene(exported.diffuse_scene, plan.blender_version);
  const EarlierLightmaps earlier = find_earlier(session, {"reference", bases}, survey, exported.list.targets);
  SavedScene saved;
  if (exported.blends) {
    saved = save_scene_with_uvs(session, survey, exported.blends->own,
                                earlier.add_to(uvs_of(exported.list.targets)));
  }
  log::info("tracing {} x {} against Blender {}", counted(exported.list.targets.size(), "lightmap"),
            counted(bases.size(), "direction"), plan.blender_version);
  return report(run_reference({scene, exported.list, bases, earlier}, settings, plan, "tracing", saved),
                settings.output);
}

std::function<int()> add_reference_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "reference", "Trace what the lightmaps of a scene should hold, with standard errors");
  auto flags = std::make_shared<SettingsFlags>(*command, Purpose::reference);
  return [flags] {
    const auto config = flags->resolve();
    if (!config) return static_cast<int>(ExitCode::ok);
    StopRequest::install();
    return trace_reference(*config);
  };
}

}  // namespace rnmbake
