// blender/log_tail.h - finds in Blender's output, while it is still being written, what means that it gets
// on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_set>

namespace rnmbake {

/// A loop without end may print without end, so a line is progress only if it says something new: paths that
/// Cycles has traced (it says so about every 30 seconds), or a line that was not there before, numbers apart.
/// Both since the script's last event, whose number the script prints, too (core/task.py).
class LogTail {
 public:
  explicit LogTail(std::filesystem::path file) : file_(std::move(file)) {}

  /// Reads what was added. True if anything in it was progress.
  bool poll();

  /// Whether something could not be written for want of room. Blender goes on then, and even says that it has
  /// finished, with a picture half there.
  [[nodiscard]] bool ran_out_of_room() const { return ran_out_of_room_; }

  /// Whether Cycles has said anything since the last event, as it does while it still prepares a bake. Not
  /// every build of it can.
  [[nodiscard]] bool hears_cycles() const { return hears_cycles_; }

  /// The last event that the output speaks of; 0: none yet.
  [[nodiscard]] int event() const { return event_; }
  /// Samples that Cycles has taken of its picture (of all tiles of a large one together).
  [[nodiscard]] double samples() const { return samples_; }
  /// What Blender says that it is doing: "Synchronizing object | Cube"; "" if it says nothing.
  [[nodiscard]] const std::string& doing() const { return doing_; }

 private:
  bool read_chunk();
  bool read_line(std::string_view line);
  bool is_new(const std::string& text);

  std::filesystem::path file_;
  std::size_t read_ = 0;
  std::string rest_;  // the beginning of a line whose end has not been written yet
  int event_ = 0;
  double samples_ = 0;
  bool ran_out_of_room_ = false, progressed_ = false, hears_cycles_ = false;
  std::string doing_;
  std::unordered_set<std::size_t> said_;
};

}  // namespace rnmbake
