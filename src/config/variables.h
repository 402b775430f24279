// config/variables.h - environment variables that look like settings and are none.
#pragma once

#include <string>
#include <vector>

namespace rnmbake {

/// Names of all variables that are set and not empty.
[[nodiscard]] std::vector<std::string> variables_set();

/// Throws Error(usage) for a name RNMBAKE_* that is no setting's: it would be ignored.
void refuse_unknown_variables(const std::vector<std::string>& names);

}  // namespace rnmbake
