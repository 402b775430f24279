#include "cli/rerun.h"

#include "base/log.h"
#include "cli/run_report.h"

#include <CLI/CLI.hpp>

namespace rnmbake {

void add_rerun_flags(CLI::App& command, RerunFlags& flags) {
  command.add_flag("--why", flags.why, "list all that made the run necessary");
  command.add_flag("--force", flags.force,
                   "trace anew, even where nothing changed or the cache has what was traced before");
}

void say_why(const Reasons& reasons, bool all) {
  if (reasons.empty()) return;
  if (!all) {
    const std::string more =
        reasons.size() > 1 ? fmt::format(" (and {} more; --why lists them)", reasons.size() - 1) : "";
    log::info("because {}{}", reasons.front(), more);
    return;
  }
  for (const Reasons::value_type& reason : reasons) log::info("because {}", reason);
}

void report_last_run(const ResolvedConfig& config, const LastRun& last, RunReport& made) {
  log::info("nothing to do: {} is up to date", config.globals.output.dir.string());
  made = made_from(config);
  add_scene_inputs(last.inputs(), made);
}

}  // namespace rnmbake
