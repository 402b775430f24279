// encoding/basis_set.h - named lists of directions to bake for, and what makes such a list usable.
#pragma once

#include "base/math.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// One direction to bake for: tangent space, unit length. The name becomes a layer and part of file names.
struct BasisDirection {
  std::string name;
  Vec3 direction;
};

struct BasisSet {
  std::string name;  // "rnm", or the file that it was read from
  std::vector<BasisDirection> directions;
};

/// rnm0, rnm1, rnm2: the Half-Life 2 basis.
[[nodiscard]] BasisSet rnm_set();

/// The surface normal itself, (0, 0, 1), under the name "flat".
[[nodiscard]] BasisDirection flat_direction();

/// flat, rnm0, rnm1, rnm2: what a bake holds by default, under the name "rnm".
[[nodiscard]] BasisSet flat_and_rnm();

/// Where the set holds a direction of that name and (within 1e-3) that vector.
[[nodiscard]] std::optional<std::size_t> place_of(const BasisSet& set, const BasisDirection& wanted);

/// True where the set holds rnm0 .. rnm2 with the directions of the Half-Life 2 basis (within 1e-3).
[[nodiscard]] bool holds_rnm(const BasisSet& set);

/// True for 1 to 64 of the characters a-z A-Z 0-9 _ -, which every file system and every EXR reader accepts.
[[nodiscard]] bool is_file_safe(std::string_view name);

/// Throws Error(invalid_input), naming the set, the direction and the remedy, where a direction is not finite
/// or not of unit length (within 1e-3), a name is empty, unsafe, reserved or there twice, the list is empty,
/// or it holds the misprinted Half-Life 2 vector. Returns warnings (near duplicates), one line each.
[[nodiscard]] std::vector<std::string> check_basis(const BasisSet& set);

}  // namespace rnmbake
