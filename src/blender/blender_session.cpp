#include "blender/blender_session.h"

#include "base/error.h"
#include "base/leftovers.h"
#include "base/log.h"
#include "base/progress.h"
#include "blender/launch_watch.h"
#include "process/stop.h"

#include <algorithm>
#include <limits>
#include <map>
#include <thread>

namespace rnmbake {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string purpose_of(const Launch& launch) {
  static const std::map<std::string, std::string> purposes = {
      {"survey_entry.py", "reading the scene"},    {"export_entry.py", "writing down the scene"},
      {"lambert_entry.py", "albedo and emission"}, {"save_uvs_entry.py", "saving the scene"},
      {"render_entry.py", "Blender renders"},      {"height_map_entry.py", "baking the heights"},
      {"node_groups_entry.py", "making nodes"},
  };
  const auto found = purposes.find(launch.entry);
  return found != purposes.end() ? found->second : launch.entry;
}

}  // namespace

BlenderSession::BlenderSession(const ResolvedConfig& config, Blender& blender,
                               const std::filesystem::path& parent)
    : config_(config), blender_(blender), folder_(parent) {
  if (!settings().output.keep_temporary) return;
  folder_.keep();
  mark_as_kept(folder_.path());
  log::info("temporary files stay in {}", folder_.path().string());
}

std::filesystem::path BlenderSession::new_folder(const std::string& purpose) {
  auto folder = folder_.path() / fmt::format("{:03}-{}", launches_++, purpose);
  make_folders(folder);
  return folder;
}

LaunchLimits BlenderSession::limits() const {
  LaunchLimits limits;
  limits.stall_seconds = settings().run.timeout;
  limits.total_seconds = settings().run.launch_timeout;
  limits.memory_bytes = static_cast<std::size_t>(settings().run.memory_max) << 20;
  return limits;
}

int BlenderSession::threads(int jobs) const {
  if (settings().run.threads > 0) return settings().run.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / jobs);
}

nlohmann::json BlenderSession::run(Launch launch) {
  if (launch.threads == 0) launch.threads = threads(1);
  log::debug("{} in {}", launch.entry, launch.folder.string());
  LaunchOutcome outcome = [&] {
    Progress progress(purpose_of(launch), progress_for(log::is_quiet(), log::is_jsonl()));
    return blender_.run(launch, limits(), [&](const ProgressEvent& event) {
      progress.update(event.total > 0 ? event.done / event.total : unknown, in_words(event));
    });
  }();
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
    case Kind::outlasted:
      return failure.message + "; raise --launch-timeout if it was only slow";
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
