// ssbump/horizon/line_hull-inl.h - growth of the lines' hulls, and slopes to them, for a vector of a line's
// texels.
//
// Compiled for several instruction sets by horizon_sweep.cpp; hence the guard that opens again for each.
#if defined(RNMBAKE_SSBUMP_LINE_HULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_SSBUMP_LINE_HULL_INL_H
#undef RNMBAKE_SSBUMP_LINE_HULL_INL_H
#else
#define RNMBAKE_SSBUMP_LINE_HULL_INL_H
#endif

#include "ssbump/horizon/line_hull.h"

#include <algorithm>
#include <vector>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector's worth of neighbours on a line: texels that look towards rising (Sign 1) or falling (-1) steps,
/// and as many new points of the line, `ahead` of them.
template <int Sign, class D, class V = hn::Vec<D>>
class LineBlock {
  static constexpr float highest_slope = 1e30F;
  using Steps = hn::Rebind<std::int32_t, D>;

 public:
  /// `line`: the height at step 0. `step`: of the first texel.
  HWY_INLINE LineBlock(D d, const float* line, int step, int ahead, const Reciprocals& reciprocals)
      : d_(d),
        step_(step),
        ahead_(ahead),
        reciprocals_(reciprocals.centre()),
        points_(line + step + Sign * ahead),
        point_(hn::LoadU(d, points_)) {}

  /// Heights of the line, `ahead` of the texels.
  [[nodiscard]] HWY_INLINE V heights() const { return point_; }

  /// Pushes the new points onto the hull of all earlier ones. Returns the largest slope, in height per step,
  /// from the heights `eye` over the texels to points `ahead` and farther.
  HWY_INLINE V look_and_push(LineHull& hull, V eye) const {
    V seen = hn::Mul(hn::Sub(point_, eye), hn::Set(d_, reciprocals_[ahead_]));
    // On the hull are points that every nearer one sees under a larger slope than they see any farther one.
    // The nearest neighbours are enough to tell, on both sides, past these ones too: whoever does not see a
    // point that thus goes has what it hides among his own nearest neighbours, which he is shown one by one.
    V to_farther = hn::Set(d_, -highest_slope), from_nearer = hn::Set(d_, highest_slope);
    const auto lanes = static_cast<int>(hn::Lanes(d_));
    for (int i = 1; i < lanes; ++i) {
      const V far = hn::LoadU(d_, points_ + Sign * i), near = hn::LoadU(d_, points_ - Sign * i);
      const V per_step = hn::Set(d_, reciprocals_[i]);
      to_farther = hn::Max(to_farther, hn::Mul(hn::Sub(far, point_), per_step));
      from_nearer = hn::Min(from_nearer, hn::Mul(hn::Sub(point_, near), per_step));
      seen = hn::Max(seen, hn::Mul(hn::Sub(far, eye), hn::Set(d_, reciprocals_[ahead_ + i])));
    }
    scan(hull, eye, seen, to_farther);
    append(hull, from_nearer, to_farther);
    return seen;
  }

 private:
  /// Scans the hull from near to far. Along it slopes rise to the tangent's point, then fall.
  HWY_INLINE void scan(LineHull& hull, V eye, V& seen, V& to_farther) const {
    constexpr int at_once = 4;
    const Steps steps;
    V tangent = hn::Set(d_, -highest_slope), slope = hn::Set(d_, highest_slope), eye_slope = slope;
    auto tangent_at = hn::Set(steps, -1);
    int k = hull.count() - 1;
    while (k >= 0) {
      V before = slope, eye_before = eye_slope;
      for (const int stop = std::max(-1, k - at_once); k > stop; --k) {
        const float* const per_step = reciprocals_ + (step_ - hull.at()[k]);
        const V height = hn::Set(d_, hull.heights()[k]);
        before = slope;
        slope = hn::Mul(hn::Sub(height, point_), hn::LoadU(d_, per_step + Sign * ahead_));
        const auto steeper = hn::Gt(slope, tangent);
        tangent = hn::Max(slope, tangent);
        tangent_at = hn::IfThenElse(hn::RebindMask(steps, steeper), hn::Set(steps, k), tangent_at);
        eye_before = eye_slope;
        eye_slope = hn::Mul(hn::Sub(height, eye), hn::LoadU(d_, per_step));
        seen = hn::Max(seen, eye_slope);
      }
      if (hn::AllTrue(d_, hn::And(hn::Lt(slope, before), hn::Lt(eye_slope, eye_before)))) break;
    }
    // Points nearer than the tangent's are under the line to it.
    hull.keep(hn::GetLane(hn::MinOfLanes(steps, tangent_at)) + 1);
    to_farther = hn::Max(to_farther, tangent);
  }

  HWY_INLINE void append(LineHull& hull, V from_nearer, V to_farther) const {
    const Steps steps;
    auto at = hn::Iota(steps, step_ + Sign * ahead_);
    V height = point_;
    if constexpr (Sign > 0) {
      at = hn::Reverse(steps, at);
      height = hn::Reverse(d_, height);
      from_nearer = hn::Reverse(d_, from_nearer);
      to_farther = hn::Reverse(d_, to_farther);
    }
    const auto on_hull = hn::Gt(from_nearer, to_farther);
    hn::CompressStore(at, hn::RebindMask(steps, on_hull), steps, hull.at_end());
    hull.append(static_cast<int>(hn::CompressStore(height, on_hull, d_, hull.heights_end())));
  }

  D d_;
  int step_, ahead_;
  const float* reciprocals_;
  const float* points_;
  V point_;
};

/// The point between two of a line that stands highest over their chord; `from` where none stands over it by
/// more than `least`.
template <class D>
HWY_INLINE int highest_between(D d, const float* line, int from, int to, float least) {
  const float rise = (line[to] - line[from]) / static_cast<float>(to - from);
  const auto lanes = static_cast<int>(hn::Lanes(d));
  int top = from;
  float over = least;
  const auto look = [&](int at, float height) {
    const float here = height - line[from] - static_cast<float>(at - from) * rise;
    if (here > over) {
      over = here;
      top = at;
    }
  };
  int i = from + 1;
  if (to - i >= lanes) {
    const auto by_lane = hn::Iota(d, 0.0F), slope = hn::Set(d, rise);
    auto best = hn::Set(d, -1e30F), best_at = hn::Zero(d);
    for (; i + lanes <= to; i += lanes) {
      const auto at = hn::Add(by_lane, hn::Set(d, static_cast<float>(i - from)));
      const auto height = hn::NegMulAdd(at, slope, hn::LoadU(d, line + i));
      best_at = hn::IfThenElse(hn::Gt(height, best), at, best_at);
      best = hn::Max(best, height);
    }
    HWY_ALIGN float places[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(best_at, d, places);
    for (int lane = 0; lane < lanes; ++lane) {
      const int at = from + static_cast<int>(places[lane]);
      look(at, line[at]);
    }
  }
  for (; i < to; ++i) look(i, line[i]);
  return top;
}

/// Appends the upper hull of the heights from `from` to `to`, both among them. `parts`: memory.
template <class D>
HWY_INLINE void append_hull(D d, const float* line, int from, int to, float least,
                            std::vector<LinePoint>& hull, std::vector<LinePart>& parts) {
  hull.push_back({from, line[from]});
  if (from == to) return;
  parts.assign(1, {from, to});
  while (!parts.empty()) {
    const LinePart part = parts.back();
    parts.pop_back();
    const int top = highest_between(d, line, part.from, part.to, least);
    if (top == part.from) {
      hull.push_back({part.to, line[part.to]});
      continue;
    }
    parts.push_back({top, part.to});
    parts.push_back({part.from, top});
  }
}

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
