// ssbump/horizon/line_tiles-inl.h - the heights along some lines of a sweep, and the tiles in which lines and
// steps change places.
//
// Compiled for several instruction sets by horizon_sweep.cpp; hence the guard that opens again for each.
#if defined(RNMBAKE_SSBUMP_LINE_TILES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_SSBUMP_LINE_TILES_INL_H
#undef RNMBAKE_SSBUMP_LINE_TILES_INL_H
#else
#define RNMBAKE_SSBUMP_LINE_TILES_INL_H
#endif

#include "ssbump/horizon/horizon_azimuth.h"
#include "ssbump/horizon/horizon_grid.h"

#include <algorithm>
#include <array>
#include <vector>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many rows as lines are swept at once, of as many floats.
struct Tile {
  static constexpr std::size_t pitch = most_lines_at_once;
  HWY_ALIGN std::array<float, pitch * pitch> values;
  [[nodiscard]] float* row(int i) { return &values[static_cast<std::size_t>(i) * pitch]; }
};

/// A square of a vector's length, in squares of four.
template <class D>
HWY_INLINE void transpose(D d, const float* from, std::size_t from_pitch, float* to, std::size_t to_pitch) {
  const std::size_t count = hn::Lanes(d);
  if (count < 4) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) to[j * to_pitch + i] = from[i * from_pitch + j];
    return;
  }
#if HWY_TARGET != HWY_SCALAR
  const hn::CappedTag<float, 4> four;
  for (std::size_t i = 0; i < count; i += 4) {
    for (std::size_t j = 0; j < count; j += 4) {
      const float* const in = from + i * from_pitch + j;
      float* const out = to + j * to_pitch + i;
      const auto a = hn::LoadU(four, in), b = hn::LoadU(four, in + from_pitch);
      const auto c = hn::LoadU(four, in + 2 * from_pitch), e = hn::LoadU(four, in + 3 * from_pitch);
      const auto ab = hn::InterleaveLower(four, a, b), ce = hn::InterleaveLower(four, c, e);
      const auto ab_2 = hn::InterleaveUpper(four, a, b), ce_2 = hn::InterleaveUpper(four, c, e);
      hn::StoreU(hn::ConcatLowerLower(four, ce, ab), four, out);
      hn::StoreU(hn::ConcatUpperUpper(four, ce, ab), four, out + to_pitch);
      hn::StoreU(hn::ConcatLowerLower(four, ce_2, ab_2), four, out + 2 * to_pitch);
      hn::StoreU(hn::ConcatUpperUpper(four, ce_2, ab_2), four, out + 3 * to_pitch);
    }
  }
#endif
}

/// Steps of a sweep, evenly apart.
struct Places {
  int first = 0, stride = 1, count = 0;
};

/// Heights at places, line after line.
struct LineHeights {
  const float* heights = nullptr;
  std::size_t pitch = 0;
  [[nodiscard]] const float* line(int lane) const { return heights + static_cast<std::size_t>(lane) * pitch; }
};

/// Lines of an azimuth, side by side, that move aside over the grid from step to step.
template <class D, class V = hn::Vec<D>>
class SampledLines {
 public:
  SampledLines(const HorizonGrid& grid, const Azimuth& azimuth, int start)
      : grid_(grid), azimuth_(azimuth), start_(start), aside_soon_(static_cast<int>(azimuth.slope * soon)) {}

  LineHeights fill(std::vector<float>& memory, const Places& places) const {
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const int blocks = (places.count + lanes - 1) / lanes, padded = blocks * lanes;
    const std::size_t pitch = row_pitch(static_cast<std::size_t>(padded));
    memory.resize(pitch * static_cast<std::size_t>(lanes));
    Tile tile;
    for (int block = 0; block < blocks; ++block) {
      for (int i = 0; i < lanes; ++i) {
        const int place = std::min(block * lanes + i, places.count - 1);
        hn::Store(sample(places.first + place * places.stride), d, tile.row(i));
      }
      transpose(d, tile.row(0), Tile::pitch, memory.data() + block * lanes, pitch);
    }
    return {memory.data(), pitch};
  }

 private:
  static constexpr D d{};
  static constexpr int soon = 24;  // steps

  /// At any step, interpolated between the two texels about each line.
  HWY_INLINE V sample(int step) const {
    int line = start_;
    float part = 0;
    const GridAxis& steps = grid_.steps;
    if (step >= 0 && step < steps.period) {
      line += azimuth_.whole[static_cast<std::size_t>(step)];
      part = azimuth_.part[static_cast<std::size_t>(step)];
    } else if (steps.repeats()) {
      const int within = steps.fold(step);
      line +=
          (step - within) / steps.period * azimuth_.shift + azimuth_.whole[static_cast<std::size_t>(within)];
      part = azimuth_.part[static_cast<std::size_t>(within)];
    } else {
      const std::int64_t way = step * azimuth_.aside, whole = floor_div(way, azimuth_.steps);
      line += static_cast<int>(whole);
      part = static_cast<float>(way - whole * azimuth_.steps) / static_cast<float>(azimuth_.steps);
    }
    const auto lanes = static_cast<int>(hn::Lanes(d));
    const GridAxis& lines = grid_.lines;
    if (lines.repeats() && (line < 0 || line >= lines.size)) line = lines.fold(line);
    const float* const row = grid_.row(step);
    if (line >= 0 && line + lanes < lines.size) {
      prefetch(step, line, lanes);
      return between(row + line, part);
    }
    std::array<float, most_lines_at_once + 1> values;
    for (int i = 0; i <= lanes; ++i) values[static_cast<std::size_t>(i)] = row[lines.texel(line + i)];
    return between(values.data(), part);
  }
  /// Rows lie too far apart for a processor to foresee them.
  HWY_INLINE void prefetch(int step, int line, int lanes) const {
    if (step + soon >= grid_.steps.size || step + soon < 0) return;
    const float* const later = grid_.at(step + soon, line + aside_soon_);
    __builtin_prefetch(later);
    __builtin_prefetch(later + lanes);
  }
  HWY_INLINE static V between(const float* at, float part) {
    const V a = hn::LoadU(d, at), b = hn::LoadU(d, at + 1);
    return hn::MulAdd(hn::Set(d, part), hn::Sub(b, a), a);
  }

  const HorizonGrid& grid_;
  const Azimuth& azimuth_;
  int start_, aside_soon_;
};

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
