#include "cli/inspect.h"

#include "base/error.h"
#include "blender/late_blender.h"
#include "cli/flags/settings_flags.h"
#include "cli/inspect_scene.h"
#include "cli/inspect_write.h"
#include "pipeline/scene/scene_survey.h"
#include "process/stop.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct InspectFlags {
  explicit InspectFlags(CLI::App& command) : settings(command) {
    command.add_flag("--json", json, "one JSON object instead of the table");
  }
  SettingsFlags settings;
  bool json = false;
};

void inspect(ResolvedConfig config, bool as_json, std::ostream& out) {
  config.globals.scene.materials = SceneSettings::Materials::full;  // look at the scene as it is
  LateBlender blender(config.globals);
  BlenderSession session(config, blender);
  const SceneSurvey survey = survey_scene(session).survey;
  const Inspection inspection = inspect_scene(survey, config);
  if (as_json) {
    out << inspection_json(survey, inspection).dump(2) << '\n';
  } else {
    write_inspection(survey, inspection, out);
  }
}

}  // namespace

std::function<int()> add_inspect_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("inspect", "What is in a scene, and what would be baked at which size");
  const auto flags = std::make_shared<InspectFlags>(*command);
  return [flags] {
    const auto config = flags->settings.resolve();
    if (!config) return static_cast<int>(ExitCode::ok);
    StopRequest::install();
    inspect(*config, flags->json, std::cout);
    return static_cast<int>(ExitCode::ok);
  };
}

}  // namespace rnmbake
