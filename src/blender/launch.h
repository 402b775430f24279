// blender/launch.h - one headless run of one entry script, with limits and a typed outcome.
#pragma once

#include "blender/blend_path.h"
#include "blender/blender_info.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Script, scene and request of a launch. `folder` is private to the launch and must exist: request.json,
/// result.json, progress.jsonl, stdout.log, tmp/ and home/ are made in it.
struct Launch {
  std::string entry;               // file name in the scripts folder: "bake_entry.py"
  std::optional<BlendPath> scene;  // to open; none: factory start-up
  nlohmann::json request;          // becomes request.json, with "nonce" and "folder" added
  std::filesystem::path folder;
  int threads = 0;  // 0: Blender's own choice
  /// The one file that the script writes outside `folder`; in the request as "save_as". Must exist.
  std::optional<std::filesystem::path> save_as = {};
};

struct LaunchLimits {
  double stall_seconds = 600;    // without progress (blender/launch_watch.h, process/stall.h): hung
  double total_seconds = 0;      // 0: no limit
  std::size_t memory_bytes = 0;  // of all its processes, resident; 0: no limit
};

/// One line of progress.jsonl: the work that begins.
struct ProgressEvent {
  std::string phase;           // "load", "evaluate", "build", "bake", "save"
  std::string what;            // the object or tile in work
  double done = 0, total = 0;  // work before it, work of the whole launch; total 0: unknown
  double until = 0;            // value of `done` at its end; 0: unknown
  double samples = 0;          // of Cycles' picture; 0: none, or unknown
  std::string detail;          // from Blender's output: "33 of 256 samples", "Synchronizing object | Cube"
};

struct Finished {
  nlohmann::json result;  // what the script returned, nonce checked
  double wall_seconds = 0, cpu_seconds = 0;
  std::size_t peak_bytes = 0;  // of the Blender process
};

/// Cause of a missing result. `message` is one line, with the object if the script knew it.
struct LaunchFailure {
  enum class Kind {
    refused,  // by the script, which names the scene's defect (ExitCode in `code`)
    script,   // a Python exception: a defect of ours; the traceback is in `details`
    crashed,  // ended by a signal of its own (SIGSEGV, SIGABRT)
    killed,   // by us past LaunchLimits::memory_bytes, or by a SIGKILL that we did not send: most likely out
              // of memory
    hung,     // ended by us: no progress, or more than the limit of output
    outlasted,  // ended by us after LaunchLimits::total_seconds
    no_result,  // exit 0, but no result file with our nonce
    stopped,    // the user interrupted
  };
  Kind kind = Kind::no_result;
  int code = 0;
  std::string message, object, details;
  std::string phase;  // of the last ProgressEvent; "": the script had not begun
};

using LaunchOutcome = std::variant<Finished, LaunchFailure>;

/// Starts Blenders. Narrow, so that fakes in tests can crash at a given launch.
class Blender {
 public:
  virtual ~Blender() = default;
  [[nodiscard]] virtual const BlenderInfo& info() const = 0;
  /// `on_progress` receives every event, and the last one again at each poll while the launch runs.
  virtual LaunchOutcome run(const Launch& launch, const LaunchLimits& limits,
                            const std::function<void(const ProgressEvent&)>& on_progress) = 0;
};

}  // namespace rnmbake
