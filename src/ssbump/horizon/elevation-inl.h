// ssbump/horizon/elevation-inl.h - integrals of the lobes over a horizon along one azimuth, for a vector of
// horizons.
//
// Compiled for several instruction sets by horizon_sweep.cpp and horizon_sums.cpp; hence the guard that opens
// again for each.
#if defined(RNMBAKE_SSBUMP_ELEVATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_SSBUMP_ELEVATION_INL_H
#undef RNMBAKE_SSBUMP_ELEVATION_INL_H
#else
#define RNMBAKE_SSBUMP_ELEVATION_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// 1 / sqrt(x) for x > 0 to about 1e-6; anything for 0 that is no trouble when it is multiplied by 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V inverse_root(D d, V x) {
  const V least = hn::Max(x, hn::Set(d, 1e-30F));
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  const V y = hn::ApproximateReciprocalSqrt(least);  // at least 11 bits; then one of Newton's steps
  const V half = hn::Mul(least, hn::Set(d, 0.5F));
  return hn::Mul(y, hn::NegMulAdd(hn::Mul(half, y), y, hn::Set(d, 1.5F)));
#else
  return hn::Div(hn::Set(d, 1.0F), hn::Sqrt(least));
#endif
}

/// Two integrals over the elevations from a horizon's e to the zenith, of which every lobe of power 1 is a
/// sum:
///     along = 2 * integral of cos^2 = pi/2 - e - sin e cos e,   up = 2 * integral of sin cos = cos^2 e.
template <class V>
struct Elevation {
  V along, up;
};

/// Elevation integrals of sines in [0, 1], to 4e-7: `along` is (1 - sine)^(3/2) times a polynomial that was
/// fitted at Chebyshev's points.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Elevation<V> look_above(D d, V sine) {
  const V rest = hn::Sub(hn::Set(d, 1.0F), sine);
  V fitted = hn::Set(d, 0.00122244012F);
  fitted = hn::MulAdd(fitted, sine, hn::Set(d, -0.00617113954F));
  fitted = hn::MulAdd(fitted, sine, hn::Set(d, 0.0180595069F));
  fitted = hn::MulAdd(fitted, sine, hn::Set(d, -0.0544592484F));
  fitted = hn::MulAdd(fitted, sine, hn::Set(d, 0.356170071F));
  fitted = hn::MulAdd(fitted, sine, hn::Set(d, 1.57079666F));
  const V along = hn::Mul(hn::Mul(rest, rest), hn::Mul(inverse_root(d, rest), fitted));
  return {along, hn::NegMulAdd(sine, sine, hn::Set(d, 1.0F))};
}

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
