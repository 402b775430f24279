// ssbump/horizon/horizon_near-inl.h - the horizon within the nearest rows, for some texels side by side.
//
// Compiled for several instruction sets by horizon_sweep.cpp; hence the guard that opens again for each.
#if defined(RNMBAKE_SSBUMP_HORIZON_NEAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_SSBUMP_HORIZON_NEAR_INL_H
#undef RNMBAKE_SSBUMP_HORIZON_NEAR_INL_H
#else
#define RNMBAKE_SSBUMP_HORIZON_NEAR_INL_H
#endif

#include "ssbump/horizon/horizon_azimuth.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Maximum of the slopes to the heights given to keep().
template <class D, class V = hn::Vec<D>>
class Steepest {
 public:
  HWY_INLINE Steepest(D d, V eye) : d_(d), eye_(eye), slope_(hn::Zero(d)) {}

  HWY_INLINE void look(V height, float per_height) {
    slope_ = hn::Max(slope_, hn::Mul(hn::Sub(height, eye_), hn::Set(d_, per_height)));
  }
  /// Halfway across a patch of such a twist.
  HWY_INLINE void look(const NearStep::Middle& middle, V from, V to, V twist) {
    if (!middle.matters) return;
    const V mean = hn::Mul(hn::Add(from, to), hn::Set(d_, 0.5F));
    look(hn::MulAdd(twist, hn::Set(d_, middle.twist), mean), middle.per_height);
  }
  HWY_INLINE void keep(V slope) { slope_ = hn::Max(slope_, slope); }
  [[nodiscard]] HWY_INLINE V slope() const { return slope_; }

 private:
  D d_;
  V eye_, slope_;
};

/// The largest slope, in heights for one step and at least 0, from texels to the surface in the near rows.
/// `here`: in memory, the first of the texels. Along lines between texels the surface is straight, along a
/// ray across a patch it is a parabola.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V look_near(D d, const Azimuth::Way& way, const float* here, V eye) {
  const std::ptrdiff_t side = way.side;
  Steepest<D> steepest(d, eye);
  V height = eye;                        // of the surface where the ray meets the row
  V second = hn::LoadU(d, here + side);  // of the second texel beside the ray in that row,
  V rise = hn::Sub(second, eye);         // over the first
  const V ahead = hn::LoadU(d, here + way.near[0].row.at);
  steepest.keep(hn::MulAdd(rise, hn::Set(d, way.steep), hn::Sub(ahead, eye)));  // right at the texel
  for (const NearStep& step : way.near) {
    const float* const next = here + step.row.at;
    const V a = hn::LoadU(d, next), b = hn::LoadU(d, next + side), along = hn::Sub(b, a);
    if (!step.crosses) {
      const V there = hn::MulAdd(along, hn::Set(d, step.row.part), a);
      steepest.look(there, step.per_height);
      steepest.look(step.middle, height, there, hn::Sub(along, rise));
      second = b;
      rise = along;
      height = there;
      continue;
    }
    const V cross = hn::MulAdd(hn::Sub(b, second), hn::Set(d, step.cross_part), second);
    steepest.look(cross, step.cross_per_height);
    steepest.look(step.middle, height, cross, hn::Sub(along, rise));
    const V last = hn::LoadU(d, here + step.last), c = hn::LoadU(d, next + 2 * side);
    const V beside = hn::Sub(c, b), there = hn::MulAdd(beside, hn::Set(d, step.row.part), b);
    steepest.look(there, step.per_height);
    steepest.look(step.second_middle, cross, there, hn::Sub(beside, hn::Sub(last, second)));
    second = c;
    rise = beside;
    height = there;
  }
  return steepest.slope();
}

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
