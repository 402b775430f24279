// ssbump/horizon/horizon_beyond-inl.h - heights beyond the border at which a sweep begins.
//
// Compiled for several instruction sets by horizon_sweep.cpp; hence the guard that opens again for each.
#if defined(RNMBAKE_SSBUMP_HORIZON_BEYOND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_SSBUMP_HORIZON_BEYOND_INL_H
#undef RNMBAKE_SSBUMP_HORIZON_BEYOND_INL_H
#else
#define RNMBAKE_SSBUMP_HORIZON_BEYOND_INL_H
#endif

#include "ssbump/horizon/line_group.h"
#include "ssbump/horizon/line_hull-inl.h"
#include "ssbump/horizon/line_tiles-inl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

constexpr float least_bulge = 1e-6F;  // of the heights' range, by which a hull's points stand out

/// Starts the hulls of a group's lines with the points beyond one border: towards rising steps (Sign 1) or
/// falling ones (-1). Leaves out the points of the first block.
template <int Sign, class D>
class BorderView {
  static constexpr int most_periods = 256;     // searched for higher points
  static constexpr int every_step = 64;        // behind a border that goes on
  static constexpr float least_slope = 2e-5F;  // smaller slopes are not searched for

 public:
  BorderView(const SweepJob& job, const LineGroup& group, const SampledLines<D>& lines, SweepScratch& scratch)
      : job_(job), group_(group), lines_(lines), scratch_(scratch) {}

  void begin_hulls() const {
    for (LineHull& hull : scratch_.hulls) {
      hull.clear();
      hull.make_room();
    }
    if (!job_.grid.steps.repeats()) return look_where_it_goes_on();
    for (int lane = 0; group_.has(lane); ++lane)
      look_over_periods(group_.start() + lane, scratch_.hulls[static_cast<std::size_t>(lane)]);
  }

 private:
  /// Index of the line that continues `line` so many periods ahead; -1 where it has left the map.
  [[nodiscard]] int line_ahead(int line, int periods) const {
    line += periods * job_.azimuth.shift;
    if (job_.grid.lines.repeats()) line = job_.grid.lines.fold(line);
    return job_.lines.valid(line) ? line - job_.lines.first : -1;
  }

  /// Pushes the next period's outstanding points, then those of later periods that are higher than all
  /// before.
  void look_over_periods(int line, LineHull& hull) const {
    std::array<float, most_periods + 2> before;
    before[1] = no_height;
    const int most = std::min(most_periods, job_.reciprocals.farthest() / group_.period() - 2);
    int periods = 1;
    for (;; ++periods) {
      const int at = line_ahead(line, Sign * periods);
      if (at < 0 || periods >= most) break;
      const float record = std::max(before[static_cast<std::size_t>(periods)], highest(at, periods));
      before[static_cast<std::size_t>(periods) + 1] = record;
      if (job_.lines.highest_of_all - least_slope * static_cast<float>(periods * group_.period()) <= record)
        break;
    }
    for (int i = periods; i >= 1; --i) {
      const int at = line_ahead(line, Sign * i);
      if (at >= 0) push(hull, at, i, before[static_cast<std::size_t>(i)]);
    }
  }

  /// Greatest height of a line, but for points of the first block.
  [[nodiscard]] float highest(int at, int periods) const {
    const SweepLines& lines = job_.lines;
    const std::vector<float>& highest = periods > 1 ? lines.highest
                                        : Sign > 0  ? lines.highest_but_start
                                                    : lines.highest_but_end;
    return highest[static_cast<std::size_t>(at)];
  }

  /// Pushes points higher than `record`, from far to near, but for those of the first block.
  void push(LineHull& hull, int at, int periods, float record) const {
    if (job_.lines.highest[static_cast<std::size_t>(at)] <= record) return;
    const std::vector<LinePoint>& points = job_.lines.outstanding[static_cast<std::size_t>(at)];
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
      const LinePoint& point = points[Sign > 0 ? count - 1 - i : i];
      const int step = point.at + Sign * periods * group_.period();
      if (group_.template left_out<Sign>(step)) return;
      if (point.height > record) hull.push({step, point.height});
    }
  }

  /// Pushes points beyond a border whose heights go on. They change with the line alone, so that far away two
  /// points of each line suffice.
  void look_where_it_goes_on() const {
    const int nearest = Sign > 0 ? group_.end() + group_.ahead() : -group_.ahead() - 1;
    const int stride = std::max(1, static_cast<int>(0.5 / std::max(1e-6, std::abs(job_.azimuth.slope))));
    const int far = farthest_going_on();
    const int behind = nearest + Sign * every_step;
    push_places({behind, Sign * stride, std::max(1, far / stride)});
    push_places({nearest, Sign, every_step});
  }
  /// Distance in steps after which the lines have left the map sidewards, or no slope can be larger.
  [[nodiscard]] int farthest_going_on() const {
    const double aside = job_.grid.lines.size / std::max(1e-6, std::abs(job_.azimuth.slope)) + 1;
    const int sight = job_.reciprocals.farthest() - 2 * group_.period() - every_step - 4 * group_.pad();
    return static_cast<int>(std::min(aside, double(sight)));
  }
  void push_places(const Places& places) const {
    const LineHeights heights = lines_.fill(scratch_.far_heights, places);
    std::vector<LinePoint>& points = scratch_.beyond;
    for (int lane = 0; group_.has(lane); ++lane) {
      points.clear();
      append_hull(D(), heights.line(lane), 0, places.count - 1, least_bulge * job_.grid.range, points,
                  scratch_.parts);
      std::ranges::reverse(points);
      for (const LinePoint& point : points)
        scratch_.hulls[static_cast<std::size_t>(lane)].push(
            {places.first + point.at * places.stride, point.height});
    }
  }

  const SweepJob& job_;
  const LineGroup& group_;
  const SampledLines<D>& lines_;
  SweepScratch& scratch_;
};

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
