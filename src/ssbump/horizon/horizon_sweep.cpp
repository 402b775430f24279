#include "ssbump/horizon/horizon_sweep.h"

#include "ssbump/horizon/line_group.h"

#include <algorithm>
#include <array>
#include <cmath>

// What follows is compiled for each set of instructions; the order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ssbump/horizon/horizon_sweep.cpp"
#include <hwy/foreach_target.h>

#include "ssbump/horizon/elevation-inl.h"
#include "ssbump/horizon/horizon_beyond-inl.h"
#include "ssbump/horizon/horizon_near-inl.h"
#include "ssbump/horizon/line_hull-inl.h"
#include "ssbump/horizon/line_tiles-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, most_lines_at_once>;
using V = hn::Vec<D>;

/// Lines side by side, that one vector holds.
class GroupSweep {
 public:
  GroupSweep(const SweepJob& job, int group, SweepScratch& scratch)
      : job_(job),
        grid_(job.grid),
        azimuth_(job.azimuth),
        scratch_(scratch),
        group_(job, group, static_cast<int>(hn::Lanes(d))),
        lines_(grid_, azimuth_, group_.start()) {
    scratch.hulls.resize(static_cast<std::size_t>(group_.count()));
  }

  /// Both ends of a line are kept whole, for who stands near them sees some of their points otherwise.
  void find_outstanding() {
    const LineHeights heights =
        lines_.fill(scratch_.heights, {-group_.pad(), 1, group_.end() + 2 * group_.pad()});
    const int end = std::min(group_.period(), group_.end() - group_.period() + group_.ahead());
    for (int lane = 0; group_.has(lane); ++lane) {
      const auto at = static_cast<std::size_t>(group_.start() + lane - job_.lines.first);
      std::vector<LinePoint>& points = job_.lines.outstanding[at];
      const float* const line = heights.line(lane) + group_.pad();
      points.clear();
      const int middle = std::max(end, group_.period() - end);
      for (int i = 0; i < end; ++i) points.push_back({i, line[i]});
      if (end < middle)
        append_hull(d, line, end, middle - 1, least_bulge * grid_.range, points, scratch_.parts);
      for (int i = middle; i < group_.period(); ++i) points.push_back({i, line[i]});
      float& but_start = job_.lines.highest_but_start[at] = no_height;
      float& but_end = job_.lines.highest_but_end[at] = no_height;
      for (const LinePoint& point : points) {
        if (!group_.left_out<1>(point.at + group_.period())) but_start = std::max(but_start, point.height);
        if (!group_.left_out<-1>(point.at - group_.period())) but_end = std::max(but_end, point.height);
      }
      float& highest = job_.lines.highest[at] = no_height;
      for (const LinePoint& point : points) highest = std::max(highest, point.height);
    }
  }

  void both_ways() {
    const SweepTarget& target = job_.target;
    int first = target.first_step, last = target.last_step;
    while (first < last && !group_.wanted(group_.texel_line(first))) ++first;
    while (first < last && !group_.wanted(group_.texel_line(last - 1))) --last;
    if (first == last) return;
    heights_ = lines_.fill(scratch_.heights, {-group_.pad(), 1, group_.end() + 2 * group_.pad()});
    one_way<1>(first, last);
    one_way<-1>(first, last);
  }

 private:
  static constexpr D d{};

  template <int Sign>
  void one_way(int first, int last) {
    const int lowest = first / group_.count() * group_.count(),
              highest = (last - 1) / group_.count() * group_.count();  // blocks
    BorderView<Sign, D>(job_, group_, lines_, scratch_).begin_hulls();
    if (Sign > 0)
      push_unwanted<Sign>(highest + group_.count() + group_.ahead(), group_.end() + group_.ahead());
    else
      push_unwanted<Sign>(-group_.ahead(), lowest - group_.ahead());
    for (int i = 0; i <= highest - lowest; i += group_.count()) {
      const int step = Sign > 0 ? highest - i : lowest + i;
      block<Sign>(step, std::max(step, first), std::min(step + group_.count(), last));
    }
  }

  /// Pushes the points between the border and the first block.
  template <int Sign>
  void push_unwanted(int from, int to) {
    if (from >= to) return;
    std::vector<LinePoint>& points = scratch_.beyond;
    for (int lane = 0; group_.has(lane); ++lane) {
      points.clear();
      append_hull(d, heights_.line(lane) + group_.pad(), from, to - 1, least_bulge * grid_.range, points,
                  scratch_.parts);
      if (Sign > 0) std::ranges::reverse(points);
      for (const LinePoint& point : points) scratch_.hulls[static_cast<std::size_t>(lane)].push(point);
    }
  }

  /// Computes the horizons at steps `from` to `to` of the block at `step`.
  template <int Sign>
  void block(int step, int from, int to) {
    Tile &near = tiles_[0], &texels = tiles_[1], &straight = tiles_[2];
    Tile &texels_by_line = tiles_[3], &straight_by_line = tiles_[4];
    for (int at = from; at < to; ++at) {
      const int line = group_.texel_line(at), i = at - step;
      if (group_.wanted(line)) look_near<Sign>(at, line, near.row(i), texels.row(i), straight.row(i));
    }
    transpose(d, texels.row(0), Tile::pitch, texels_by_line.row(0), Tile::pitch);
    transpose(d, straight.row(0), Tile::pitch, straight_by_line.row(0), Tile::pitch);
    Tile &far_by_line = texels, &far = straight;
    for (int lane = 0; group_.has(lane); ++lane) {
      const float* const line = heights_.line(lane) + group_.pad();
      const LineBlock<Sign, D> block(d, line, step, group_.ahead(), job_.reciprocals);
      const V texel = hn::Load(d, texels_by_line.row(lane));
      const V beside =
          smaller_of_like_sign(hn::Sub(hn::LoadU(d, line + step), texel),
                               hn::Sub(block.heights(), hn::Load(d, straight_by_line.row(lane))));
      const V slope =
          block.look_and_push(scratch_.hulls[static_cast<std::size_t>(lane)], hn::Add(texel, beside));
      hn::Store(slope, d, far_by_line.row(lane));
    }
    transpose(d, far_by_line.row(0), Tile::pitch, far.row(0), Tile::pitch);
    const V per_step = hn::Set(d, azimuth_.per_step);
    for (int at = from; at < to; ++at) {
      const int line = group_.texel_line(at), i = at - step;
      if (!group_.wanted(line)) continue;
      const V slope = hn::Max(hn::Load(d, near.row(i)), hn::Load(d, far.row(i)));
      put<Sign>(hn::Mul(slope, per_step), at, line);
    }
  }

  /// A line may pass up to half a texel beside the texel's centre. Its points are seen from as much higher up
  /// as the line is higher than the texel, or planes would stand in their own light; but where that differs
  /// between the texel and the first of the points, as at cliffs, from as little higher as there is.
  static V smaller_of_like_sign(V a, V b) {
    const V smaller = hn::IfThenElse(hn::Lt(hn::Abs(a), hn::Abs(b)), a, b);
    return hn::IfThenElseZero(hn::Gt(hn::Mul(a, b), hn::Zero(d)), smaller);
  }

  /// Writes, for the texels at a step, the slope to the near rows, their heights, and the heights straight
  /// ahead, at the line's first point.
  template <int Sign>
  void look_near(int step, int line, float* slope, float* texels, float* straight) const {
    prefetch<Sign>(step, line);
    const Azimuth::Way& way = azimuth_.ways[Sign > 0 ? 0 : 1];
    const float* const here = grid_.at(step, line);
    const float* const beyond = here + way.beyond.at;
    const V texel = hn::LoadU(d, here), a = hn::LoadU(d, beyond), b = hn::LoadU(d, beyond + way.side);
    hn::Store(HWY_NAMESPACE::look_near(d, way, here, texel), d, slope);
    hn::Store(texel, d, texels);
    hn::Store(hn::MulAdd(hn::Sub(b, a), hn::Set(d, way.beyond.part), a), d, straight);
  }

  /// Each step is in another page, which no processor foresees.
  template <int Sign>
  void prefetch(int step, int line) const {
    const int soon = step + Sign * (group_.count() + group_.ahead());
    if (soon < 0 || soon >= grid_.steps.size) return;
    __builtin_prefetch(grid_.at(soon, line));
    __builtin_prefetch(grid_.at(soon, line + group_.count()));
  }

  /// Writes the sines of horizons of these slopes.
  template <int Sign>
  void put(V slope, int step, int line) const {
    const V sine = hn::Mul(slope, inverse_root(d, hn::MulAdd(slope, slope, hn::Set(d, 1.0F))));
    const V scaled = hn::MulAdd(hn::Min(sine, hn::Set(d, 1.0F)), hn::Set(d, whole_sine), hn::Set(d, 0.5F));
    const hn::Rebind<std::int32_t, D> integers;
    const hn::Rebind<std::uint16_t, D> shorts;
    const auto sines = hn::DemoteTo(shorts, hn::ConvertTo(integers, scaled));
    const SweepTarget& target = job_.target;
    std::uint16_t* const to =
        job_.sines[Sign > 0 ? 0 : 1] + static_cast<std::size_t>(step - target.first_step) * target.pitch();
    if (group_.all_wanted(line)) return hn::StoreU(sines, shorts, to + (line - target.first_line));
    HWY_ALIGN std::array<std::uint16_t, most_lines_at_once> values;
    hn::Store(sines, shorts, values.data());
    for (int i = 0; i < group_.count(); ++i) {
      const int texel = group_.target_line(line, i);
      if (texel >= 0) to[texel] = values[static_cast<std::size_t>(i)];
    }
  }

  const SweepJob& job_;
  const HorizonGrid& grid_;
  const Azimuth& azimuth_;
  SweepScratch& scratch_;
  LineGroup group_;
  SampledLines<D> lines_;
  LineHeights heights_;
  std::array<Tile, 5> tiles_{};
};

void find_outstanding_here(const SweepJob& job, int group, SweepScratch& scratch) {
  GroupSweep(job, group, scratch).find_outstanding();
}
void sweep_group_here(const SweepJob& job, int group, SweepScratch& scratch) {
  GroupSweep(job, group, scratch).both_ways();
}
int lines_here() {
  return static_cast<int>(hn::Lanes(D()));
}

}  // namespace
}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rnmbake {
namespace {

HWY_EXPORT(find_outstanding_here);
HWY_EXPORT(sweep_group_here);
HWY_EXPORT(lines_here);

constexpr double least_rise = 0.01;  // of a horizon, behind a border that goes on

}  // namespace

int farthest_sight(const HorizonGrid& grid) {
  constexpr int most_places = 1 << 20, periods = 256;
  const int period = grid.steps.period;
  if (grid.steps.repeats()) return std::clamp(periods, 4, std::max(4, most_places / period)) * period + 256;
  const double useful = std::min(static_cast<double>(grid.range) / least_rise, double{most_places});
  return static_cast<int>(useful) + 2 * period + 1024;
}

int lines_at_once() {
  return HWY_DYNAMIC_DISPATCH(lines_here)();
}

std::vector<std::string> sweep_instructions() {
  hwy::SetSupportedTargetsForTest(0);
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_sweep_instructions(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name != hwy::TargetName(target)) continue;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
  }
}

void begin_lines(SweepLines& lines, const HorizonGrid& grid, const Azimuth& azimuth) {
  if (grid.lines.repeats()) {
    lines.first = 0;
    lines.count = grid.lines.period;
  } else {  // all that are over the map at some step
    const auto [least, most] = std::ranges::minmax(azimuth.nearest);
    lines.first = -most;
    lines.count = grid.lines.size + most - least;
  }
  if (grid.steps.repeats()) {
    for (std::vector<float>* highest : {&lines.highest, &lines.highest_but_start, &lines.highest_but_end})
      highest->resize(static_cast<std::size_t>(lines.count));
    lines.outstanding.resize(lines.highest.size());
  }
}

void find_outstanding(const SweepJob& job, int group, SweepScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(find_outstanding_here)(job, group, scratch);
}

void sweep_group(const SweepJob& job, int group, SweepScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(sweep_group_here)(job, group, scratch);
}

}  // namespace rnmbake
#endif
