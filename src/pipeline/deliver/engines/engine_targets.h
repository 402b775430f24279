// pipeline/deliver/engines/engine_targets.h - the engines by the names that users type.
#pragma once

#include "pipeline/deliver/engine_target.h"

#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// Every engine, in the order of --help.
[[nodiscard]] const std::vector<const EngineTarget*>& engine_targets();

/// Throws Error(usage) for a name that is none.
[[nodiscard]] const EngineTarget& engine_target(std::string_view name);

/// Encodings that any of them has a decoder for.
[[nodiscard]] std::vector<std::string> delivered_encodings();

}  // namespace rnmbake
