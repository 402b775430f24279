// cli/rerun.h - commands that know whether their last run into a folder was this very one.
#pragma once

#include "pipeline/lightmaps/last_run.h"

namespace CLI {
class App;
}

namespace rnmbake {

struct RunReport;

struct RerunFlags {
  bool why = false, force = false;
};

/// --why and --force, for commands that trace. `flags` must live as long as `command`.
void add_rerun_flags(CLI::App& command, RerunFlags& flags);

/// Says what made the run necessary; with --why all of it.
void say_why(const Reasons& reasons, bool all);

/// Says that there is nothing to do, and reports what the last run made.
void report_last_run(const ResolvedConfig& config, const LastRun& last, RunReport& made);

}  // namespace rnmbake
