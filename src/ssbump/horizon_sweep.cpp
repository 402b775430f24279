#include "ssbump/horizon_sweep.h"

#include "ssbump/elevation.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed within this file alone

namespace rnmbake {
namespace {

constexpr int most_periods = 256;     // that are looked over for something higher
constexpr int every_step = 64;        // behind a border that goes on
constexpr double least_rise = 0.01;   // of a horizon, behind a border that goes on
constexpr float least_slope = 2e-5F;  // what cannot rise above is not looked for

void fill_lanes(float* values, int how_many, const HorizonGrid& grid, const float* row, int line) {
  for (int i = 0; i < how_many; ++i) values[i] = row[grid.lines.texel(line + i)];
}

template <int Width>
class GroupSweep {
  using L = Lanes<Width>;
  using Float = typename L::Float;
  using Int = typename L::Int;
  static constexpr int count = Width;

 public:
  RNM_LANES GroupSweep(const SweepJob& job, int group)
      : job_(job),
        grid_(job.grid),
        azimuth_(job.azimuth),
        start_(job.lines.first + group * count),
        period_(job.grid.steps.period) {}

  RNM_LANES void highest() {
    Float top;
    L::set(top, no_height);
    Int first = {}, last = {};
    for (int step = 0; step < period_; ++step) {
      Float height;
      sample(height, step);
      first = height > top ? step - Int{} : first;
      last = height >= top ? step - Int{} : last;
      L::keep_larger(top, height);
    }
    SweepLines& lines = job_.lines;
    for (int i = 0; i < count && lines.valid(start_ + i); ++i) {
      const auto at = static_cast<std::size_t>(start_ + i - lines.first);
      lines.highest[at] = top[i];
      lines.first_at[at] = first[i];
      lines.last_at[at] = last[i];
    }
  }

  RNM_LANES void both_ways(SweepScratch& scratch) {
    const SweepTarget& target = job_.target;
    int first = target.first_step, last = target.last_step;
    while (first < last && !wanted(texel_line(first))) ++first;
    while (first < last && !wanted(texel_line(last - 1))) --last;
    if (first == last) return;
    scratch.slopes.resize(static_cast<std::size_t>(period_) * count);
    one_way<1>(scratch, first, last);
    one_way<-1>(scratch, first, last);
  }

 private:
  /// The heights of the lines at any step, interpolated between the two texels about each.
  RNM_LANES void sample(Float& height, int step) const {
    int line = start_;
    float part = 0;
    if (step >= 0 && step < period_) {
      line += azimuth_.whole[static_cast<std::size_t>(step)];
      part = azimuth_.part[static_cast<std::size_t>(step)];
    } else if (grid_.steps.repeats()) {
      const int within = grid_.steps.fold(step);
      line += (step - within) / period_ * azimuth_.shift + azimuth_.whole[static_cast<std::size_t>(within)];
      part = azimuth_.part[static_cast<std::size_t>(within)];
    } else {
      const std::int64_t way = step * azimuth_.aside, whole = floor_div(way, azimuth_.steps);
      line += static_cast<int>(whole);
      part = static_cast<float>(way - whole * azimuth_.steps) / static_cast<float>(azimuth_.steps);
    }
    if (grid_.lines.repeats() && (line < 0 || line >= grid_.lines.size)) line = grid_.lines.fold(line);
    const float* row = grid_.row(step);
    Float a, b;
    if (line >= 0 && line + count < grid_.lines.size) {
      L::load(a, row + line);
      L::load(b, row + line + 1);
    } else {
      std::array<float, count + 1> values;
      fill_lanes(values.data(), count + 1, grid_, row, line);
      L::load(a, values.data());
      L::load(b, values.data() + 1);
    }
    height = a + part * (b - a);
  }

  /// The texel that lane 0 stands on at a step; negative where other lanes have come to the next period.
  RNM_LANES int texel_line(int step) const {
    int line = start_ + azimuth_.nearest[static_cast<std::size_t>(step)];
    if (!grid_.lines.repeats()) return line;
    if (line < 0 || line >= grid_.lines.period) line = grid_.lines.fold(line);
    return line + count > grid_.lines.period ? line - grid_.lines.period : line;
  }
  /// The texel of the target of a lane, or -1.
  RNM_LANES int target_line(int line, int lane) const {
    if (!job_.lines.valid(start_ + lane)) return -1;
    int texel = line + lane;
    if (grid_.lines.repeats() && texel < 0) texel += grid_.lines.period;
    const SweepTarget& target = job_.target;
    return texel >= target.first_line && texel < target.last_line ? texel - target.first_line : -1;
  }
  RNM_LANES bool wanted(int line) const {
    const SweepTarget& target = job_.target;
    if (line < target.last_line && line + count > target.first_line) return true;
    return grid_.lines.repeats() && line < 0 && line + grid_.lines.period < target.last_line;
  }

  /// Each step is in another page, which no processor foresees.
  template <int Sign>
  RNM_LANES void prefetch(int step, int line) const {
    constexpr int soon = 6;
    const std::ptrdiff_t at = std::clamp(line, 0, grid_.lines.size - 1);
    const int height_step = step - Sign * soon;
    if (height_step >= 0 && height_step < grid_.steps.size) {
      const float* heights = grid_.heights + static_cast<std::ptrdiff_t>(height_step) * grid_.pitch + at;
      __builtin_prefetch(heights);
      __builtin_prefetch(heights + count);
    }
    const SweepTarget& target = job_.target;
    const int sum_step = step - Sign * soon;
    if (Sign > 0 || sum_step < target.first_step || sum_step >= target.last_step ||
        line < target.first_line || line >= target.last_line)
      return;
    const float* sums = target.sums.data() +
                        static_cast<std::size_t>(sum_step - target.first_step) * target.pitch() +
                        (line - target.first_line);
    for (int c = 0; c < target.planes; ++c, sums += target.plane()) {
      __builtin_prefetch(sums, 1);
      __builtin_prefetch(sums + count, 1);
    }
  }

  /// The largest slope to the places about the texels, and how high the surface is right behind them.
  RNM_LANES void look_near(Float& slope, Float& beyond, const Azimuth::Way& way, int step, int line,
                           const Float& eye) const {
    const float* here = grid_.at(step, line);
    for (const NearTap& tap : way.taps) {
      Float height;
      look_at(height, here, tap);
      L::keep_larger(slope, (height - eye) * tap.per_height);
    }
    for (const PatchTap& tap : way.patches) {
      Float a, b, c, d;
      L::load(a, here + tap.at);
      L::load(b, here + tap.at + 1);
      L::load(c, here + tap.at + grid_.pitch);
      L::load(d, here + tap.at + grid_.pitch + 1);
      const Float height = a * tap.shares[0] + b * tap.shares[1] + c * tap.shares[2] + d * tap.shares[3];
      L::keep_larger(slope, (height - eye) * tap.per_height);
    }
    look_at(beyond, here, way.beyond);
  }
  RNM_LANES static void look_at(Float& height, const float* here, const NearTap& tap) {
    Float a, b;
    L::load(a, here + tap.a);
    L::load(b, here + tap.b);
    height = a + tap.part * (b - a);
  }

  /// What stands beyond the border.
  template <int Sign>
  RNM_LANES void look_beyond(Hull<Width>& hull) const {
    const bool repeats = grid_.steps.repeats();
    int place = repeats ? look_over_periods<Sign>(hull) : farthest_going_on();
    // Far behind a border that goes on, heights change with the lines alone: two looks at each are enough.
    const int stride = repeats ? 1 : std::max(1, static_cast<int>(0.5 / std::abs(azimuth_.slope)));
    while (place > period_ + job_.near_rows) {
      Float height;
      sample(height, step_at<Sign>(place));
      hull.push(static_cast<float>(place), height);
      place -= place - stride > period_ + every_step ? stride : 1;
    }
  }

  /// Until the lines have left the map sidewards, or nothing can rise by least_rise any more.
  RNM_LANES int farthest_going_on() const {
    const double aside = grid_.lines.size / std::abs(azimuth_.slope);
    const double useful = static_cast<double>(grid_.range) / least_rise;
    return period_ + job_.near_rows + static_cast<int>(std::min({aside, useful, double{1 << 20}})) + 1;
  }

  /// Of the periods after the next one, whatever is higher than all before. Returns where the next period's
  /// highest points end.
  template <int Sign>
  RNM_LANES int look_over_periods(Hull<Width>& hull) const {
    std::array<Float, most_periods + 1> before;
    L::set(before[1], no_height);
    int periods = 1;
    int farthest = 0;
    for (;; ++periods) {
      Float top;
      int at = 0;
      const bool there = tops<Sign>(top, at, periods);
      if (periods == 1) farthest = at;
      if (!there || periods == most_periods) break;
      Float record = before[static_cast<std::size_t>(periods)];
      L::keep_larger(record, top);
      before[static_cast<std::size_t>(periods + 1)] = record;
      Float enough;
      L::set(enough, job_.lines.highest_of_all - least_slope * static_cast<float>(periods * period_));
      if (!L::any_above(enough, record)) break;
    }
    for (int ahead = periods; ahead > 1; --ahead) {
      Float top;
      int at = 0;
      const Float& record = before[static_cast<std::size_t>(ahead)];
      if (!tops<Sign>(top, at, ahead) || !L::any_above(top, record)) continue;
      for (int i = period_ - 1; i >= 0; --i) {
        const int place = ahead * period_ + i;
        Float height;
        sample(height, step_at<Sign>(place));
        if (L::any_above(height, record)) hull.push(static_cast<float>(place), height);
      }
    }
    return period_ + farthest;
  }
  /// Places count up in the direction of looking and begin at the border behind.
  template <int Sign>
  RNM_LANES int step_at(int place) const {
    return Sign > 0 ? place : period_ - 1 - place;
  }
  /// The highest points of the lines so many periods ahead, and the farthest place of them within it.
  template <int Sign>
  RNM_LANES bool tops(Float& top, int& farthest, int periods) const {
    const SweepLines& lines = job_.lines;
    std::array<float, count> values;
    bool there = false;
    farthest = 0;
    for (int i = 0; i < count; ++i) {
      int line = start_ + i + Sign * periods * azimuth_.shift;
      if (grid_.lines.repeats()) line = grid_.lines.fold(line);
      values[static_cast<std::size_t>(i)] = no_height;
      if (!lines.valid(line)) continue;
      there = true;
      const auto at = static_cast<std::size_t>(line - lines.first);
      values[static_cast<std::size_t>(i)] = lines.highest[at];
      farthest = std::max(farthest, Sign > 0 ? lines.last_at[at] : period_ - 1 - lines.first_at[at]);
    }
    L::load(top, values.data());
    return there;
  }

  template <int Sign>
  RNM_LANES void one_way(SweepScratch& scratch, int first, int last) const {
    const auto& way = azimuth_.ways[Sign > 0 ? 0 : 1];
    Hull<Width> hull(scratch.hull);
    look_beyond<Sign>(hull);
    const float ahead = static_cast<float>(job_.near_rows + 1);
    const int nearest = Sign > 0 ? first : period_ - last;  // the last place to be looked from
    for (int place = period_ - 1; place >= nearest; --place) {
      const int step = step_at<Sign>(place);
      Float height;
      sample(height, step_at<Sign>(place + job_.near_rows + 1));
      const int line = step >= first && step < last ? texel_line(step) : 0;
      if (step < first || step >= last || !wanted(line)) {
        hull.push(static_cast<float>(place) + ahead, height);
        continue;
      }
      Float eye, slope, far, straight;
      prefetch<Sign>(step, line);
      L::load(eye, grid_.at(step, line));
      L::set(slope, 0);
      look_near(slope, straight, way, step, line, eye);
      // The line may pass up to half a texel beside the texel's centre: its points are seen from as much
      // higher up as the first of them is higher than straight ahead, or planes would stand in their own
      // light.
      const Float beside = eye + (height - straight);
      hull.push_and_look(far, static_cast<float>(place), beside, ahead, height);
      L::keep_larger(slope, far);
      slope = slope * azimuth_.per_step;
      float* kept = &scratch.slopes[static_cast<std::size_t>(step) * count];
      if constexpr (Sign > 0) {
        L::store(kept, slope);
      } else {
        Float forth;
        L::load(forth, kept);
        add(step, line, forth, slope);
      }
    }
  }

  RNM_LANES void add(int step, int line, const Float& forth, const Float& back) const {
    std::array<Float, SweepWeightsPlanes> sums;
    Elevation<Width> seen;
    look_above<Width>(seen, forth);
    if (job_.linear) {
      linear<true>(sums, azimuth_.ways[0].lobes, seen, forth);
      look_above<Width>(seen, back);
      linear<false>(sums, azimuth_.ways[1].lobes, seen, back);
    } else {
      tabled<true>(sums, azimuth_.ways[0].lobes, seen);
      look_above<Width>(seen, back);
      tabled<false>(sums, azimuth_.ways[1].lobes, seen);
    }
    put(sums, step, line);
  }

  static constexpr int SweepWeightsPlanes = SsbumpWeights::channels;

  template <bool First>
  RNM_LANES static void linear(std::array<Float, SweepWeightsPlanes>& sums, const AzimuthLobes& lobes,
                               const Elevation<Width>& seen, const Float& slope) {
    for (std::size_t c = 0; c < 3; ++c) {
      const AzimuthLobes::Linear& lobe = lobes.linear[c];
      const Float part = seen.along * lobe.along + seen.up * lobe.up;
      const Float value = slope < lobe.begins ? lobe.at_most - Float{} : part;
      sums[c] = First ? value : sums[c] + value;
    }
    const Float up = seen.up * lobes.linear[SsbumpWeights::up].up;
    sums[3] = First ? up : sums[3] + up;
  }

  template <bool First>
  RNM_LANES static void tabled(std::array<Float, SweepWeightsPlanes>& sums, const AzimuthLobes& lobes,
                               const Elevation<Width>& seen) {
    constexpr int entries = AzimuthLobes::table_steps + 2;
    const Float scaled = seen.sine * static_cast<float>(AzimuthLobes::table_steps);
    const Int index = __builtin_convertvector(scaled, Int);
    const Float part = scaled - __builtin_convertvector(index, Float);
    for (int c = 0; c < SsbumpWeights::ambient; ++c) {
      const float* table = lobes.table.data() + c * entries;
      Float low, high;
      for (int i = 0; i < count; ++i) {
        low[i] = table[index[i]];
        high[i] = table[index[i] + 1];
      }
      const Float value = low + part * (high - low);
      sums[static_cast<std::size_t>(c)] = First ? value : sums[static_cast<std::size_t>(c)] + value;
    }
    const Float ambient = seen.up * lobes.linear[SsbumpWeights::ambient].up;
    sums[SsbumpWeights::ambient] = First ? ambient : sums[SsbumpWeights::ambient] + ambient;
  }

  RNM_LANES void put(const std::array<Float, SweepWeightsPlanes>& sums, int step, int line) const {
    SweepTarget& target = job_.target;
    float* to = target.sums.data() + static_cast<std::size_t>(step - target.first_step) * target.pitch();
    const bool plain =
        line >= target.first_line && line + count <= target.last_line && job_.lines.valid(start_ + count - 1);
    for (std::size_t c = 0; c < static_cast<std::size_t>(target.planes); ++c, to += target.plane()) {
      if (plain) {
        Float old;
        L::load(old, to + (line - target.first_line));
        L::store(to + (line - target.first_line), old + sums[c]);
        continue;
      }
      for (int i = 0; i < count; ++i) {
        const int texel = target_line(line, i);
        if (texel >= 0) to[texel] += sums[c][i];
      }
    }
  }

  const SweepJob& job_;
  const HorizonGrid& grid_;
  const Azimuth& azimuth_;
  int start_, period_;
};

template <int Width>
RNM_LANES void run(const SweepJob& job, int group, SweepScratch* scratch) {
  GroupSweep<Width> sweep(job, group);
  if (scratch == nullptr)
    sweep.highest();
  else
    sweep.both_ways(*scratch);
}

void run_baseline(const SweepJob& job, int group, SweepScratch* scratch) {
  run<4>(job, group, scratch);
}
#ifdef __x86_64__
__attribute__((target("avx2,fma,bmi,bmi2"))) void run_avx2(const SweepJob& job, int group,
                                                           SweepScratch* scratch) {
  run<8>(job, group, scratch);
}
__attribute__((target("avx512f,avx512vl,avx512bw,avx512dq,fma,bmi,bmi2,prefer-vector-width=512"))) void
run_avx512(const SweepJob& job, int group, SweepScratch* scratch) {
  run<16>(job, group, scratch);
}
#endif

std::atomic<SweepIsa>& isa_in_use() {
  static std::atomic<SweepIsa> isa = best_isa();
  return isa;
}

void run_best(const SweepJob& job, int group, SweepScratch* scratch) {
#ifdef __x86_64__
  switch (isa_in_use().load(std::memory_order_relaxed)) {
    case SweepIsa::avx512:
      return run_avx512(job, group, scratch);
    case SweepIsa::avx2:
      return run_avx2(job, group, scratch);
    case SweepIsa::baseline:
      break;
  }
#endif
  run_baseline(job, group, scratch);
}

}  // namespace

SweepIsa best_isa() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
    return SweepIsa::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return SweepIsa::avx2;
#endif
  return SweepIsa::baseline;
}

void limit_isa(SweepIsa isa) {
  isa_in_use() = std::min(isa, best_isa());
}

int lines_at_once() {
  return 4 << static_cast<int>(isa_in_use().load(std::memory_order_relaxed));
}

int SweepLines::groups() const {
  return (count + lines_at_once() - 1) / lines_at_once();
}

SweepLines lines_of(const HorizonGrid& grid, const Azimuth& azimuth) {
  SweepLines lines;
  if (grid.lines.repeats()) {
    lines.count = grid.lines.period;
  } else {  // all that are over the map at some step
    const auto [least, most] = std::ranges::minmax(azimuth.nearest);
    lines.first = -most;
    lines.count = grid.lines.size + most - least;
  }
  if (grid.steps.repeats()) {
    lines.highest.resize(static_cast<std::size_t>(lines.count));
    lines.first_at.resize(lines.highest.size());
    lines.last_at.resize(lines.highest.size());
  }
  return lines;
}

void find_highest(const SweepJob& job, int group) {
  run_best(job, group, nullptr);
}

void sweep_group(const SweepJob& job, int group, SweepScratch& scratch) {
  run_best(job, group, &scratch);
}

}  // namespace rnmbake
