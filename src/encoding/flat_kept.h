// encoding/flat_kept.h - the four numbers that err least where none return all four bakes.
#pragma once

#include "encoding/lobe.h"

#include <array>

namespace rnmbake {

/// Of flat, rnm0, rnm1, rnm2, in this order: of one colour, E/pi.
using FourBakes = std::array<double, 4>;

struct FourNumbers {
  double a = 0;
  Vec3d v = Vec3d(0);
  bool has_converged = true;  // the lobe returns each bake within 1e-6 of the greatest
};

/// v / a of the least sum over the three basis directions of (lobe - bake)^2 within the box |v_i| <= range a,
/// among the numbers whose lobe returns the flat bake, which must be above 0. `directions`: flat, rnm0 to
/// rnm2 in the space whose axes the box follows. `towards` is where steps start from: any vector in that
/// space.
[[nodiscard]] Vec3d flat_kept(Lobe lobe, const FourBakes& bakes, const std::array<Vec3d, 4>& directions,
                              const Vec3d& towards, double range);

}  // namespace rnmbake
