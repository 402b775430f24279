// encoding/refit/newton_lanes.h - Newton's steps of several texels side by side.
#pragma once

#include "encoding/lobe.h"
#include "encoding/refit/flat_kept.h"

#include <array>
#include <span>

namespace rnmbake {

/// Solves lobe(a, v, direction i) = bake i from the numbers that stand there, as far as Newton's steps
/// arrive: has_converged says where. Elsewhere the numbers mean nothing. Bakes are in units of the greatest.
/// Knows zh3_lobe and geomerics_lobe; others do not arrive. Does not depend on what stands side by side.
void newton_in_lanes(Lobe lobe, const std::array<Vec3d, 4>& directions, std::span<const FourBakes> bakes,
                     std::span<FourNumbers> numbers);

}  // namespace rnmbake
