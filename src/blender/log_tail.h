// blender/log_tail.h - finds signs of progress in Blender's output while Blender writes it.
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

  /// Reads the lines added since the last call. True if one of them means progress.
  bool poll();

  /// Whether Blender ran out of disk space. It goes on then, and reports success with a picture half written.
  [[nodiscard]] bool ran_out_of_room() const { return ran_out_of_room_; }

  /// Whether Cycles has printed a line since the last event, as it does while it prepares a bake. Some builds
  /// never do.
  [[nodiscard]] bool hears_cycles() const { return hears_cycles_; }

  /// Number of the last event in the output; 0: none yet.
  [[nodiscard]] int event() const { return event_; }
  /// Samples that Cycles has taken of its picture (of all tiles of a large one together).
  [[nodiscard]] double samples() const { return samples_; }
  /// Blender's status: "Synchronizing object | Cube"; "" where it prints none.
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
