// tests/support/bases.h - the directions that a plain bake asks for.
#pragma once

#include "encoding/basis_set.h"

#include <vector>

namespace rnmbake {

inline std::vector<BasisDirection> default_bases() {
  std::vector<BasisDirection> bases{flat_direction()};
  for (const BasisDirection& basis : rnm_set().directions) bases.push_back(basis);
  return bases;
}

}  // namespace rnmbake
