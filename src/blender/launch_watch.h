// blender/launch_watch.h - progress of a running launch, from its script's events and Blender's output.
#pragma once

#include "blender/launch.h"
#include "blender/log_tail.h"
#include "blender/progress_tail.h"

#include <functional>
#include <string>

namespace rnmbake {

/// In words: "bake atlas 1 of 2, 33 of 256 samples".
[[nodiscard]] std::string in_words(const ProgressEvent& event);

class LaunchWatch {
 public:
  /// `folder` of the launch. `on_progress` receives every event of the script, and at each poll the last one
  /// again with details from Blender's output; before the first event, one without a phase.
  LaunchWatch(const std::filesystem::path& folder, std::function<void(const ProgressEvent&)> on_progress);

  /// True if the launch made progress since the last call.
  bool poll();

  /// Last event of the script, with details from Blender's output; no phase: none yet.
  [[nodiscard]] const ProgressEvent& last() const { return last_; }

  /// See LogTail.
  [[nodiscard]] bool ran_out_of_room() const { return log_.ran_out_of_room(); }

 private:
  bool is_new(const ProgressEvent& event);
  void go_on_with_last();

  ProgressTail events_;
  LogTail log_;
  std::function<void(const ProgressEvent&)> on_progress_;
  int heard_ = 0;
  ProgressEvent begun_, last_;
};

}  // namespace rnmbake
