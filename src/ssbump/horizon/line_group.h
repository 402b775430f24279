// ssbump/horizon/line_group.h - lines of a sweep side by side, as many as a vector holds, and the texels
// under them.
#pragma once

#include "ssbump/horizon/sweep_lines.h"

#include <cstddef>

namespace rnmbake {

class LineGroup {
 public:
  LineGroup(const SweepJob& job, int group, int count)
      : job_(job), count_(count), start_(job.lines.first + group * count) {}

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int start() const { return start_; }
  /// The last group may be less than full.
  [[nodiscard]] bool has(int lane) const { return lane < count_ && job_.lines.valid(start_ + lane); }

  /// Steps of one period, in whole blocks of count().
  [[nodiscard]] int period() const { return job_.grid.steps.period; }
  [[nodiscard]] int end() const { return (period() + count_ - 1) / count_ * count_; }
  /// Steps from a texel to the first point of its line that counts; nearer ones are the near rows'.
  [[nodiscard]] int ahead() const { return job_.near_rows + 1; }
  /// Steps past both ends at which the lines' heights are needed, in whole blocks.
  [[nodiscard]] int pad() const { return (ahead() + 2 * count_ - 1) / count_ * count_; }

  /// Whether a point beyond the border belongs to the first block of the sweep towards rising (Sign 1) or
  /// falling steps (-1), and is left out of the hull before it.
  template <int Sign>
  [[nodiscard]] bool left_out(int step) const {
    return Sign > 0 ? step < end() + ahead() : step >= -ahead();
  }

  /// The texel that lane 0 stands on at a step; negative where other lanes have come to the next period.
  [[nodiscard]] int texel_line(int step) const {
    const GridAxis& lines = job_.grid.lines;
    int line = start_ + job_.azimuth.nearest[static_cast<std::size_t>(step)];
    if (!lines.repeats()) return line;
    if (line < 0 || line >= lines.period) line = lines.fold(line);
    return line + count_ > lines.period ? line - lines.period : line;
  }
  /// The texel of the target of a lane, or -1.
  [[nodiscard]] int target_line(int line, int lane) const {
    if (!has(lane)) return -1;
    int texel = line + lane;
    if (job_.grid.lines.repeats() && texel < 0) texel += job_.grid.lines.period;
    const SweepTarget& target = job_.target;
    return texel >= target.first_line && texel < target.last_line ? texel - target.first_line : -1;
  }
  /// Whether some lane stands on a texel of the target.
  [[nodiscard]] bool wanted(int line) const {
    const SweepTarget& target = job_.target;
    if (line < target.last_line && line + count_ > target.first_line) return true;
    return job_.grid.lines.repeats() && line < 0 && line + job_.grid.lines.period < target.last_line;
  }
  /// Whether each lane stands on a texel of the target, one beside the other.
  [[nodiscard]] bool all_wanted(int line) const {
    const SweepTarget& target = job_.target;
    return line >= target.first_line && line + count_ <= target.last_line && has(count_ - 1);
  }

 private:
  const SweepJob& job_;
  int count_, start_;
};

}  // namespace rnmbake
