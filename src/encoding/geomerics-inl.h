// encoding/geomerics-inl.h - the formula of Geomerics, for one number or for lanes of them.
//
// Compiled as encoding/lanes-inl.h.
#if defined(RNMBAKE_ENCODING_GEOMERICS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_ENCODING_GEOMERICS_INL_H
#undef RNMBAKE_ENCODING_GEOMERICS_INL_H
#else
#define RNMBAKE_ENCODING_GEOMERICS_INL_H
#endif

#include "encoding/lanes-inl.h"
#include "encoding/lobe.h"

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

/// geomerics_lobe() (encoding/geomerics.h) where a is above 0.
struct Geomerics {
  template <typename Number, typename Vector>
  HWY_INLINE LobeOf<Number, Vector> operator()(Number a, const Vector& v, const Vector& normal) const {
    const Number length = sqrt(v.dot(v));
    const Vector axis = v / max(length, no_length);
    const Number r = length / (2.0 * a), p = 1.0 + 2.0 * r, ambient = (1.0 - r) / (1.0 + r);
    const Number cosine = axis.dot(normal), q = (1.0 + cosine) / 2.0;
    const auto is_lit = q > Number(0.0);  // q^p log q goes to 0
    const Number log_q = log(select(is_lit, q, 1.0)), power = select(is_lit, exp(p * log_q), 0.0);
    const Number slope = select(is_lit, p * power / q, 0.0), by_p = power * log_q;
    const Number by_r = 2.0 / ((1.0 + r) * (1.0 + r));  // -dA/dr
    return {a * ambient + 2.0 * length * power, ambient + by_r * r - 8.0 * r * r * by_p,
            axis * (2.0 * power + 4.0 * r * by_p - by_r / 2.0) + (normal - axis * cosine) * slope};
  }
};

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
