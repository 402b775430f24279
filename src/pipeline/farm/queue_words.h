// pipeline/farm/queue_words.h - what jobs for queues call a plan.
#pragma once

#include "pipeline/farm/farm_plan.h"

#include <filesystem>
#include <string>

namespace rnmbake {

/// What a queue shows of it.
[[nodiscard]] std::string job_name(const FarmPlan& plan);

/// Names that a job for a queue cannot hold: with control characters, or bytes that are no UTF-8. Throws
/// Error(usage).
void require_queue_words(const std::filesystem::path& plan_folder);

}  // namespace rnmbake
