// encoding/refit/flat_kept.h - the four numbers that err least where none return all four bakes.
#pragma once

#include "encoding/lobe.h"

#include <array>
#include <span>
#include <vector>

namespace rnmbake {

/// Of flat, rnm0, rnm1, rnm2, in this order: of one colour, E/pi.
using FourBakes = std::array<double, 4>;

struct FourNumbers {
  double a = 0;
  Vec3d v = Vec3d(0);
  bool has_converged = true;  // the lobe returns each bake within 1e-6 of the greatest
};

/// One colour of a texel, in the space whose axes a range follows.
struct FlatKeptProblem {
  FourBakes bakes{};                  // the flat one above 0
  std::array<Vec3d, 4> directions{};  // flat, rnm0, rnm1, rnm2
  Vec3d towards{0};                   // where steps start from: any vector
};

/// For each problem v / a of the least sum over the three basis directions of (lobe - bake)^2 within the box
/// |v_i| <= range a, among the numbers whose lobe returns the flat bake. `lobe`: sh2_lobe, zh3_lobe or
/// geomerics_lobe. Does not depend on what stands side by side.
[[nodiscard]] std::vector<Vec3d> flat_kept(Lobe lobe, std::span<const FlatKeptProblem> problems,
                                           double range);

}  // namespace rnmbake
