// encoding/zh3-inl.h - the formula of ZH3, for one number or for lanes of them.
//
// Compiled as encoding/lanes-inl.h.
#if defined(RNMBAKE_ENCODING_ZH3_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_ENCODING_ZH3_INL_H
#undef RNMBAKE_ENCODING_ZH3_INL_H
#else
#define RNMBAKE_ENCODING_ZH3_INL_H
#endif

#include "encoding/lanes-inl.h"
#include "encoding/lobe.h"

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

/// zh3_lobe() (encoding/zh3.h) where a is above 0.
struct Zh3 {
  template <typename Number, typename Vector>
  HWY_INLINE LobeOf<Number, Vector> operator()(Number a, const Vector& v, const Vector& normal) const {
    constexpr double scale = 0.27950849718747373, greatest = 1.7320508075688772;  // sqrt5 / 8, sqrt3
    const Number length = sqrt(v.dot(v)), unbounded = greatest / 2 * length / a;
    const auto is_free = unbounded < Number(greatest);
    const Number rho = select(is_free, unbounded, greatest);
    const Number divisor = max(length, no_length);
    const Vector axis = v / divisor;
    const Number cosine = axis.dot(normal), shape = 3.0 * cosine * cosine - 1.0;
    const Number strength = rho * (0.08 + 0.6 * rho), slope = select(is_free, 0.08 + 1.2 * rho, 0.0);
    return {a + v.dot(normal) + scale * a * strength * shape, 1.0 + scale * shape * (strength - slope * rho),
            normal + axis * (scale * greatest / 2 * shape * slope) +
                (normal - axis * cosine) * (scale * 6 * a / divisor * strength * cosine)};
  }
};

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
