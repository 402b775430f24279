// ssbump/elevation.h - what is seen over a horizon along one azimuth, for some horizons at once.
#pragma once

#include "ssbump/horizon_vector.h"

namespace rnmbake {

/// Of a horizon's slope s >= 0, with e = atan s: sine = sin e, and the two integrals over the elevations from
/// e to the zenith that every lobe of power 1 is made of:
///     along = 2 * integral of cos^2 = pi/2 - e - sin e cos e,   up = 2 * integral of sin cos = cos^2 e.
template <int Width>
struct Elevation {
  typename Lanes<Width>::Float sine, along, up;
};

/// To 4e-7: `along` is (1 - sine)^(3/2) times a polynomial that was fitted at Chebyshev's points.
template <int Width>
RNM_LANES void look_above(Elevation<Width>& seen, const typename Lanes<Width>::Float& slope) {
  using L = Lanes<Width>;
  using Float = typename L::Float;
  Float cosine, root;
  L::inverse_root(cosine, 1.0F + slope * slope);
  seen.sine = slope * cosine;
  const Float z = seen.sine, zero{};
  Float rest = 1.0F - z;
  L::keep_larger(rest, zero);
  L::inverse_root(root, rest);
  const Float fitted =
      1.57079666F +
      z * (0.356170071F +
           z * (-0.0544592484F + z * (0.0180595069F + z * (-0.00617113954F + z * 0.00122244012F))));
  seen.along = rest * rest * root * fitted;
  seen.up = cosine * cosine;
}

}  // namespace rnmbake
