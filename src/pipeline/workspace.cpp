#include "pipeline/workspace.h"

#include "base/error.h"
#include "base/log.h"
#include "process/stop.h"

#include <algorithm>
#include <thread>

namespace rnmbake {

Workspace::Workspace(const ResolvedConfig& config, Blender& blender) : config_(config), blender_(blender) {
  if (!settings().output.keep_temporary) return;
  folder_.keep();
  log::info("temporary files stay in {}", folder_.path().string());
}

std::filesystem::path Workspace::new_folder(const std::string& purpose) {
  auto folder = folder_.path() / fmt::format("{:03}-{}", launches_++, purpose);
  make_folders(folder);
  return folder;
}

LaunchLimits Workspace::limits() const {
  LaunchLimits limits;
  limits.silence_seconds = settings().run.timeout;
  return limits;
}

int Workspace::threads(int jobs) const {
  if (settings().run.threads > 0) return settings().run.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / jobs);
}

nlohmann::json Workspace::run(Launch launch) {
  if (launch.threads == 0) launch.threads = threads(1);
  log::debug("{} in {}", launch.entry, launch.folder.string());
  LaunchOutcome outcome = blender_.run(launch, limits(), [](const ProgressEvent&) {});
  if (auto* failure = std::get_if<LaunchFailure>(&outcome)) {
    const bool says_where = failure->kind == LaunchFailure::Kind::refused;
    if (!says_where) failure->message = settings().scene.file.string() + ": " + failure->message;
    throw_failure(*failure);
  }
  return std::get<Finished>(std::move(outcome)).result;
}

std::string describe(const LaunchFailure& failure) {
  using Kind = LaunchFailure::Kind;
  switch (failure.kind) {
    case Kind::crashed:
      return failure.message + "; try another Blender with --blender, or leave the object out with --exclude";
    case Kind::hung:
      return failure.message + "; raise --timeout if it was only slow";
    case Kind::script:
      return fmt::format("a script of rnmbake failed, which is a defect: {}", failure.message);
    case Kind::no_result:
      return failure.message + "; --keep-temporary keeps what it printed";
    case Kind::refused:
    case Kind::killed:
    case Kind::stopped:
      break;
  }
  return failure.message;
}

void throw_failure(const LaunchFailure& failure) {
  if (failure.kind == LaunchFailure::Kind::stopped) throw Interrupted{StopRequest::signal()};
  if (!failure.details.empty()) log::debug("{}", failure.details);
  const bool refused = failure.kind == LaunchFailure::Kind::refused;
  throw Error(refused ? static_cast<ExitCode>(failure.code) : ExitCode::tasks_failed, describe(failure));
}

}  // namespace rnmbake
