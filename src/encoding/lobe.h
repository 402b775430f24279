// encoding/lobe.h - E/pi as a function of the normal that four numbers determine, and its gradient.
#pragma once

#include "base/math.h"

namespace rnmbake {

/// E/pi of one colour for a unit normal, and its derivatives by the four numbers.
struct LobeValue {
  double value = 0;
  double by_a = 0;
  Vec3d by_v = Vec3d(0);
};

/// A decoder of a (mean over all directions) and v (towards the light): sh2_lobe, zh3_lobe, geomerics_lobe.
/// Of degree 1: twice a and v give twice the value. Turns with v and the normal, whatever their space.
using Lobe = LobeValue (*)(double a, const Vec3d& v, const Vec3d& normal);

}  // namespace rnmbake
