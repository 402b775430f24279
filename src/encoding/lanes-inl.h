// encoding/lanes-inl.h - numbers of several texels side by side, written as one number is.
//
// Compiled for several instruction sets by refit/newton_lanes.cpp and refit/flat_kept.cpp; hence the guard
// that opens again for each. What includes it once is compiled for the set that every machine has.
#if defined(RNMBAKE_ENCODING_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_ENCODING_LANES_INL_H
#undef RNMBAKE_ENCODING_LANES_INL_H
#else
#define RNMBAKE_ENCODING_LANES_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Doubles of as many texels as a vector holds. Comparisons give masks, for select() and any().
struct Lanes {
  using D = hn::CappedTag<double, 8>;
  using Mask = hn::Mask<D>;
  static constexpr std::size_t most = 8;

  static std::size_t count() { return hn::Lanes(D()); }
  static HWY_INLINE Lanes load(const double* from) { return Lanes(hn::Load(D(), from)); }
  HWY_INLINE void store(double* to) const { hn::Store(raw, D(), to); }

  Lanes() = default;
  HWY_INLINE Lanes(double same) : raw(hn::Set(D(), same)) {}
  HWY_INLINE explicit Lanes(hn::Vec<D> lanes) : raw(lanes) {}

  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.raw, b.raw)); }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.raw, b.raw)); }
  friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.raw, b.raw)); }
  friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return Lanes(hn::Div(a.raw, b.raw)); }
  friend HWY_INLINE Lanes operator-(Lanes a) { return Lanes(hn::Neg(a.raw)); }
  friend HWY_INLINE Mask operator<(Lanes a, Lanes b) { return hn::Lt(a.raw, b.raw); }
  friend HWY_INLINE Mask operator>(Lanes a, Lanes b) { return hn::Gt(a.raw, b.raw); }

  hn::Vec<D> raw;
};

HWY_INLINE Lanes sqrt(Lanes a) {
  return Lanes(hn::Sqrt(a.raw));
}
HWY_INLINE Lanes exp(Lanes a) {
  return Lanes(hn::CallExp(Lanes::D(), a.raw));
}
HWY_INLINE Lanes log(Lanes a) {
  return Lanes(hn::CallLog(Lanes::D(), a.raw));
}
HWY_INLINE Lanes select(Lanes::Mask mask, Lanes yes, Lanes no) {
  return Lanes(hn::IfThenElse(mask, yes.raw, no.raw));
}
HWY_INLINE Lanes min(Lanes a, Lanes b) {
  return Lanes(hn::Min(a.raw, b.raw));
}
HWY_INLINE Lanes max(Lanes a, Lanes b) {
  return Lanes(hn::Max(a.raw, b.raw));
}
HWY_INLINE bool any(Lanes::Mask mask) {
  return !hn::AllFalse(Lanes::D(), mask);
}

// The same of one number.
using std::exp;
using std::log;
using std::max;
using std::sqrt;
HWY_INLINE double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
HWY_INLINE bool any(bool mask) {
  return mask;
}

/// Divisor of a vector that is 0, for an axis of 0.
constexpr double no_length = 1e-150;

/// A vector of each texel.
struct LaneVector {
  Lanes x, y, z;

  [[nodiscard]] HWY_INLINE Lanes dot(const LaneVector& v) const { return x * v.x + y * v.y + z * v.z; }
  friend HWY_INLINE LaneVector operator+(const LaneVector& a, const LaneVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE LaneVector operator-(const LaneVector& a, const LaneVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE LaneVector operator*(const LaneVector& a, Lanes scale) {
    return {a.x * scale, a.y * scale, a.z * scale};
  }
  friend HWY_INLINE LaneVector operator/(const LaneVector& a, Lanes scale) { return a * (1.0 / scale); }
};

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
