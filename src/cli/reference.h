// cli/reference.h - rnmbake reference: a scene goes in, traced lightmaps with standard errors come out.
#pragma once

#include "cli/rerun.h"
#include "config/resolve.h"
#include "pipeline/local/local_targets.h"
#include "pipeline/scene/make_targets.h"
#include "scene/survey.h"

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

struct RunReport;

/// Traces the scene of these settings into their output folder, unless the last run did. `made`: what became
/// of it. Returns the exit code; throws as its steps.
int trace_reference(const ResolvedConfig& config, const RerunFlags& flags, RunReport& made);

/// What a bake does between the steps of its tracing; each may be empty.
struct BetweenTraceSteps {
  bool anew = false;  // nothing that was kept is used
  std::function<void(const SceneSurvey&)> surveyed;
  /// In place of all that writes; returns the exit code.
  std::function<int(const SceneSurvey&, const TargetList&)> preview;
  /// Those of the targets that are traced, with what stays.
  std::function<LocalTargets(const SceneSurvey&, const TargetList&, const FindEarlier&)> choose;
  std::function<void(const SceneSurvey&, const LocalTargets&)> delivered;  // where no object failed
};

/// The same for a bake with engine embree, whether or not the last run did.
int trace_bake(const ResolvedConfig& config, const BetweenTraceSteps& between, RunReport& made);

/// Registers `reference` and its flags; the function runs it and returns the exit code.
std::function<int()> add_reference_command(CLI::App& app);

}  // namespace rnmbake
