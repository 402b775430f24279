// encoding/refit/packing.h - v/a within the range that an engine's texture can hold, by a fit and not by a
// clamp.
#pragma once

#include "encoding/lobe.h"
#include "encoding/refit/refit.h"

#include <array>
#include <span>
#include <vector>

namespace rnmbake {

/// How engines keep v: t = 1/2 + v / (2 K a) in [0, 1] for each axis of the space that they store, so that
/// |v_i| <= K a. K is 2 in Bakery's SH and MonoSH, 4 in Godot.
struct Packing {
  double range = 2;  // K, above 0
  int bits = 0;      // of t: 8, 16, or 0 for a float
};

/// One colour of a texel as it is packed.
struct PackedNumbers {
  double a = 0;
  Vec3d t = Vec3d(0.5);
};

/// v / a out of t.
[[nodiscard]] inline Vec3d unpacked_ratio(const Vec3d& t, double range) {
  return (t * 2 - Vec3d(1)) * range;
}

/// What is packed, in the space that is stored, whose axes the range's box follows.
struct FreeFit {
  FourBakes bakes{};
  std::array<Vec3d, 4> directions{};  // flat, rnm0, rnm1, rnm2
  FourNumbers numbers;                // that return the bakes
};

/// The numbers within the range that err least. Those of the free fit are kept where the range holds them.
/// Beyond, the least sum over the three basis directions of (lobe - bake)^2 within the box |v_i| <= K a,
/// among those whose lobe returns the flat bake; after rounding t, a is scaled so that it still does. A flat
/// bake that is not above 0 is packed as darkness.
[[nodiscard]] std::vector<PackedNumbers> packed(Lobe lobe, std::span<const FreeFit> fits,
                                                const Packing& packing);

/// The free fit lies outside the range.
[[nodiscard]] bool is_out_of_range(const FourNumbers& free_fit, double range);

}  // namespace rnmbake
