#include "ssbump/horizon_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

// What follows is compiled for each set of instructions; the order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ssbump/horizon_sweep.cpp"
#include <hwy/foreach_target.h>

#include "ssbump/elevation-inl.h"
#include "ssbump/horizon_near-inl.h"
#include "ssbump/line_hull-inl.h"
#include "ssbump/line_tiles-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, most_lines_at_once>;
using V = hn::Vec<D>;

constexpr int most_periods = 256;     // that are looked over for something higher
constexpr int every_step = 64;        // behind a border that goes on
constexpr float least_slope = 2e-5F;  // what cannot rise above is not looked for
constexpr float least_bulge = 1e-6F;  // of the heights' range, by which a hull's points stand out

/// Lines side by side, that one vector holds.
class GroupSweep {
 public:
  GroupSweep(const SweepJob& job, int group, SweepScratch& scratch)
      : job_(job),
        grid_(job.grid),
        azimuth_(job.azimuth),
        scratch_(scratch),
        count_(static_cast<int>(hn::Lanes(d))),
        start_(job.lines.first + group * count_),
        period_(grid_.steps.period),
        blocks_((period_ + count_ - 1) / count_),
        ahead_(job.near_rows + 1),
        lines_(grid_, azimuth_, start_) {
    scratch.hulls.resize(static_cast<std::size_t>(count_));
  }

  /// Both ends of a line are kept whole, for who stands near them sees some of their points otherwise.
  void find_outstanding() {
    const LineHeights heights = lines_.fill(scratch_.heights, {-pad(), 1, blocks_ * count_ + 2 * pad()});
    const int end = std::min(period_, blocks_ * count_ - period_ + ahead_);
    for (int lane = 0; lane < count_ && job_.lines.valid(start_ + lane); ++lane) {
      const auto at = static_cast<std::size_t>(start_ + lane - job_.lines.first);
      std::vector<LinePoint>& points = job_.lines.outstanding[at];
      const float* const line = heights.line(lane) + pad();
      points.clear();
      const int middle = std::max(end, period_ - end);
      for (int i = 0; i < end; ++i) points.push_back({i, line[i]});
      if (end < middle) append_hull(d, line, end, middle - 1, bulge(), points, scratch_.parts);
      for (int i = middle; i < period_; ++i) points.push_back({i, line[i]});
      float top = points[0].height;
      for (const LinePoint& point : points) top = std::max(top, point.height);
      job_.lines.highest[at] = top;
    }
  }

  void both_ways() {
    const SweepTarget& target = job_.target;
    int first = target.first_step, last = target.last_step;
    while (first < last && !wanted(texel_line(first))) ++first;
    while (first < last && !wanted(texel_line(last - 1))) --last;
    if (first == last) return;
    heights_ = lines_.fill(scratch_.heights, {-pad(), 1, blocks_ * count_ + 2 * pad()});
    one_way<1>(first, last);
    one_way<-1>(first, last);
  }

 private:
  static constexpr D d{};

  /// How far the lines' heights are needed past the borders: whole vectors.
  [[nodiscard]] int pad() const { return (ahead_ + 2 * count_ - 1) / count_ * count_; }
  [[nodiscard]] float bulge() const { return least_bulge * grid_.range; }

  /// The texel that lane 0 stands on at a step; negative where other lanes have come to the next period.
  [[nodiscard]] int texel_line(int step) const {
    int line = start_ + azimuth_.nearest[static_cast<std::size_t>(step)];
    if (!grid_.lines.repeats()) return line;
    if (line < 0 || line >= grid_.lines.period) line = grid_.lines.fold(line);
    return line + count_ > grid_.lines.period ? line - grid_.lines.period : line;
  }
  /// The texel of the target of a lane, or -1.
  [[nodiscard]] int target_line(int line, int lane) const {
    if (!job_.lines.valid(start_ + lane)) return -1;
    int texel = line + lane;
    if (grid_.lines.repeats() && texel < 0) texel += grid_.lines.period;
    const SweepTarget& target = job_.target;
    return texel >= target.first_line && texel < target.last_line ? texel - target.first_line : -1;
  }
  [[nodiscard]] bool wanted(int line) const {
    const SweepTarget& target = job_.target;
    if (line < target.last_line && line + count_ > target.first_line) return true;
    return grid_.lines.repeats() && line < 0 && line + grid_.lines.period < target.last_line;
  }

  // ---- what stands beyond the border

  template <int Sign>
  void look_beyond() {
    for (LineHull& hull : scratch_.hulls) {
      hull.clear();
      hull.make_room();
    }
    if (!grid_.steps.repeats()) return look_where_it_goes_on<Sign>();
    for (int lane = 0; lane < count_ && job_.lines.valid(start_ + lane); ++lane)
      look_over_periods<Sign>(start_ + lane, scratch_.hulls[static_cast<std::size_t>(lane)]);
  }

  /// The line that a line has become so many periods ahead; -1 where it has left the map.
  [[nodiscard]] int line_ahead(int line, int periods) const {
    line += periods * azimuth_.shift;
    if (grid_.lines.repeats()) line = grid_.lines.fold(line);
    return job_.lines.valid(line) ? line - job_.lines.first : -1;
  }

  /// Of the next period whatever stands out, of those after it whatever is higher than all before.
  template <int Sign>
  void look_over_periods(int line, LineHull& hull) const {
    std::array<float, most_periods + 2> before;
    before[1] = no_height;
    const int most = std::min(most_periods, job_.reciprocals.farthest() / period_ - 2);
    int periods = 1;
    for (;; ++periods) {
      const int at = line_ahead(line, Sign * periods);
      if (at < 0 || periods >= most) break;
      const float record = std::max(before[static_cast<std::size_t>(periods)], highest<Sign>(at, periods));
      before[static_cast<std::size_t>(periods) + 1] = record;
      if (job_.lines.highest_of_all - least_slope * static_cast<float>(periods * period_) <= record) break;
    }
    for (int i = periods; i >= 1; --i) {
      const int at = line_ahead(line, Sign * i);
      if (at >= 0) push<Sign>(hull, at, i, before[static_cast<std::size_t>(i)]);
    }
  }

  /// The first block takes in the nearest points behind the border, not the hull before it.
  template <int Sign>
  [[nodiscard]] bool left_out(int step) const {
    return Sign > 0 ? step < blocks_ * count_ + ahead_ : step >= -ahead_;
  }
  /// Of what is not left out.
  template <int Sign>
  [[nodiscard]] float highest(int at, int periods) const {
    if (periods > 1) return job_.lines.highest[static_cast<std::size_t>(at)];
    float top = no_height;
    for (const LinePoint& point : job_.lines.outstanding[static_cast<std::size_t>(at)])
      if (!left_out<Sign>(point.at + Sign * period_)) top = std::max(top, point.height);
    return top;
  }

  /// What is higher than `record`, from far to near, and not left out.
  template <int Sign>
  void push(LineHull& hull, int at, int periods, float record) const {
    if (job_.lines.highest[static_cast<std::size_t>(at)] <= record) return;
    const std::vector<LinePoint>& points = job_.lines.outstanding[static_cast<std::size_t>(at)];
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
      const LinePoint& point = points[Sign > 0 ? count - 1 - i : i];
      const int step = point.at + Sign * periods * period_;
      if (left_out<Sign>(step)) return;
      if (point.height > record) hull.push({step, point.height});
    }
  }

  /// Behind a border that goes on heights change with the lines alone: far away, two looks at each are
  /// enough.
  template <int Sign>
  void look_where_it_goes_on() {
    const int nearest = Sign > 0 ? blocks_ * count_ + ahead_ : -ahead_ - 1;
    const int stride = std::max(1, static_cast<int>(0.5 / std::max(1e-6, std::abs(azimuth_.slope))));
    const int far = farthest_going_on();
    const int behind = nearest + Sign * every_step;
    push_places<Sign>({behind, Sign * stride, std::max(1, far / stride)});
    push_places<Sign>({nearest, Sign, every_step});
  }
  /// Until the lines have left the map sidewards, or nothing can rise any more.
  [[nodiscard]] int farthest_going_on() const {
    const double aside = grid_.lines.size / std::max(1e-6, std::abs(azimuth_.slope)) + 1;
    const int sight = job_.reciprocals.farthest() - 2 * period_ - every_step - 4 * pad();
    return static_cast<int>(std::min(aside, double(sight)));
  }
  template <int Sign>
  void push_places(const Places& places) {
    const LineHeights heights = lines_.fill(scratch_.far_heights, places);
    std::vector<LinePoint>& points = scratch_.beyond;
    for (int lane = 0; lane < count_ && job_.lines.valid(start_ + lane); ++lane) {
      points.clear();
      append_hull(d, heights.line(lane), 0, places.count - 1, bulge(), points, scratch_.parts);
      for (auto point = points.rbegin(); point != points.rend(); ++point)
        scratch_.hulls[static_cast<std::size_t>(lane)].push(
            {places.first + point->at * places.stride, point->height});
    }
  }

  // ---- along the lines

  template <int Sign>
  void one_way(int first, int last) {
    const int lowest = first / count_ * count_, highest = (last - 1) / count_ * count_;  // blocks
    look_beyond<Sign>();
    if (Sign > 0)
      push_unwanted<Sign>(highest + count_ + ahead_, blocks_ * count_ + ahead_);
    else
      push_unwanted<Sign>(-ahead_, lowest - ahead_);
    for (int i = 0; i <= highest - lowest; i += count_) {
      const int step = Sign > 0 ? highest - i : lowest + i;
      block<Sign>(step, std::max(step, first), std::min(step + count_, last));
    }
  }

  /// What stands between the border and the points that the first block takes in.
  template <int Sign>
  void push_unwanted(int from, int to) {
    if (from >= to) return;
    std::vector<LinePoint>& points = scratch_.beyond;
    for (int lane = 0; lane < count_ && job_.lines.valid(start_ + lane); ++lane) {
      points.clear();
      append_hull(d, heights_.line(lane) + pad(), from, to - 1, bulge(), points, scratch_.parts);
      if (Sign > 0) std::ranges::reverse(points);
      for (const LinePoint& point : points) scratch_.hulls[static_cast<std::size_t>(lane)].push(point);
    }
  }

  /// Steps `from` to `to` of the block at `step` are wanted.
  template <int Sign>
  void block(int step, int from, int to) {
    Tile near, raised{}, across;
    for (int i = 0; i < count_; ++i) {
      const int at = step + i, line = at >= from && at < to ? texel_line(at) : 0;
      V slope = hn::Zero(d), rise = slope;
      if (at >= from && at < to && wanted(line)) look_near<Sign>(slope, rise, at, line);
      hn::Store(slope, d, near.row(i));
      hn::Store(rise, d, raised.row(i));
    }
    transpose(d, raised.row(0), Tile::pitch, across.row(0), Tile::pitch);
    Tile& seen = raised;
    for (int lane = 0; lane < count_ && job_.lines.valid(start_ + lane); ++lane) {
      const LineBlock<Sign, D> block(d, heights_.line(lane) + pad(), step, ahead_, job_.reciprocals);
      const V eye = hn::Add(hn::Load(d, across.row(lane)), block.heights());
      const V slope = block.look_and_push(scratch_.hulls[static_cast<std::size_t>(lane)], eye);
      hn::Store(slope, d, seen.row(lane));
    }
    transpose(d, seen.row(0), Tile::pitch, across.row(0), Tile::pitch);
    const V per_step = hn::Set(d, azimuth_.per_step);
    for (int at = from; at < to; ++at) {
      const V slope = hn::Max(hn::Load(d, near.row(at - step)), hn::Load(d, across.row(at - step)));
      const int line = texel_line(at);
      if (wanted(line)) put<Sign>(hn::Mul(slope, per_step), at, line);
    }
  }

  /// The slope to what is near, and how high over the line's first point an eye is that looks at the line.
  /// The line may pass up to half a texel beside the texel's centre: its points are seen from as much higher
  /// up as the first of them is higher than straight ahead, or planes would stand in their own light.
  template <int Sign>
  void look_near(V& slope, V& rise, int step, int line) const {
    prefetch<Sign>(step, line);
    const Azimuth::Way& way = azimuth_.ways[Sign > 0 ? 0 : 1];
    const float* const here = grid_.at(step, line);
    const float* const beyond = here + way.beyond.at;
    const V texel = hn::LoadU(d, here), a = hn::LoadU(d, beyond), b = hn::LoadU(d, beyond + way.side);
    const V straight = hn::MulAdd(hn::Sub(b, a), hn::Set(d, way.beyond.part), a);
    slope = HWY_NAMESPACE::look_near(d, way, here, texel);
    rise = hn::Sub(texel, straight);
  }

  /// Each step is in another page, which no processor foresees.
  template <int Sign>
  void prefetch(int step, int line) const {
    const int soon = step + Sign * (count_ + ahead_);
    if (soon < 0 || soon >= grid_.steps.size) return;
    __builtin_prefetch(grid_.at(soon, line));
    __builtin_prefetch(grid_.at(soon, line + count_));
  }

  /// Of horizons of such slopes.
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
    if (line >= target.first_line && line + count_ <= target.last_line &&
        job_.lines.valid(start_ + count_ - 1))
      return hn::StoreU(sines, shorts, to + (line - target.first_line));
    HWY_ALIGN std::array<std::uint16_t, most_lines_at_once> values;
    hn::Store(sines, shorts, values.data());
    for (int i = 0; i < count_; ++i) {
      const int texel = target_line(line, i);
      if (texel >= 0) to[texel] = values[static_cast<std::size_t>(i)];
    }
  }

  const SweepJob& job_;
  const HorizonGrid& grid_;
  const Azimuth& azimuth_;
  SweepScratch& scratch_;
  int count_, start_, period_, blocks_, ahead_;
  SampledLines<D> lines_;
  LineHeights heights_;
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
    lines.highest.resize(static_cast<std::size_t>(lines.count));
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
