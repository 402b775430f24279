// bench/ssbump_closed_forms.h - places on surfaces whose weights are known in closed form.
#pragma once

#include "sampled_weights.h"

#include <string>
#include <vector>

namespace rnmbake {

/// Power 1.
struct ClosedForm {
  std::string name;
  HeightField field;
  Texel texel;
  Channels weights{};
};

[[nodiscard]] std::vector<ClosedForm> closed_forms();

}  // namespace rnmbake
