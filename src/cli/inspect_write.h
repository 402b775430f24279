// cli/inspect_write.h - an inspection as text for people and as JSON for programs (docs/inspect.md).
#pragma once

#include "cli/inspect_scene.h"

#include <iosfwd>

#include <nlohmann/json.hpp>

namespace rnmbake {

void write_inspection(const SceneSurvey& survey, const Inspection& inspection, std::ostream& out);

[[nodiscard]] nlohmann::json inspection_json(const SceneSurvey& survey, const Inspection& inspection);

}  // namespace rnmbake
