// pipeline/dispatch/cycles_settings.h - Cycles' settings out of the user's.
#pragma once

#include "bake/plan.h"
#include "config/bake_settings.h"

namespace rnmbake {

[[nodiscard]] CyclesSettings cycles_settings(const BakingSettings& bake, const ObjectSettings& object);

}  // namespace rnmbake
