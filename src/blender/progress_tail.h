// blender/progress_tail.h - reads progress.jsonl while a script is still writing it.
#pragma once

#include "blender/launch.h"

#include <filesystem>
#include <functional>
#include <string>

namespace rnmbake {

class ProgressTail {
 public:
  explicit ProgressTail(std::filesystem::path file) : file_(std::move(file)) {}

  /// Calls `on_event` for every line completed since the last call; lines that are no event are passed over.
  /// True if anything was added to the file.
  bool poll(const std::function<void(const ProgressEvent&)>& on_event);

 private:
  std::filesystem::path file_;
  std::size_t read_ = 0;
  std::string rest_;  // the beginning of a line whose end has not been written yet
};

}  // namespace rnmbake
