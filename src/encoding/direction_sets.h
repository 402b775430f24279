// encoding/direction_sets.h - which directions to bake for encodings that need more than flat and rnm.
#pragma once

#include "encoding/basis_set.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// By name. Each holds flat and rnm0 to rnm2, so that every encoding of the four can be made of the same
/// bake, and rings of three or six, d0, d1, ...:
///   l1   7   and the three opposite the basis: sh2, h4 from a ring of six
///   h6  10   and three tilted by 30 degrees: h6
///   sg  10   the same: sg
///   sh3 13   and three tilted by 80 degrees, near the horizon, which tell light from below the basis'
///   horizons
///            from that above: sh3, rnm-signed
///   study 49 and t12_00, ...: rings of 5, 8, 11 and 12 normals tilted by 12.5, 35, 52 and 75 degrees, at
///            which encodings are tested (pipeline/study)
/// Condition numbers of the fits (encoding/fit/least_squares.h): sh2 9.6 on l1, h4 2.5 on l1, h6 2.9 on h6,
/// sg 19 on sg, sh3 28 on sh3; tests hold them. Nothing where there is no such set.
[[nodiscard]] std::optional<BasisSet> direction_set(std::string_view name);

/// "h6", ... where the directions are those of a set above (of sg: "h6"), "rnm" for flat and rnm, else their
/// names separated by commas: for messages.
[[nodiscard]] std::string name_of_set(const std::vector<BasisDirection>& directions);

}  // namespace rnmbake
