// report/document.h - a report as a JSON document. Private to the report room.
#pragma once

#include "report/comparison.h"

#include <nlohmann/json.hpp>

namespace rnmbake {

/// docs/report.schema.json
[[nodiscard]] nlohmann::ordered_json report_document(const Report& report);

}  // namespace rnmbake
