// pipeline/scene/launch_answer.h - answer of a launch, checked, for scenes may hold scripts.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// The regular file of the launch's folder that answer[key] names. Throws Error(tasks_failed) where there is
/// none.
[[nodiscard]] std::filesystem::path answered_file(const nlohmann::json& answer, const char* key,
                                                  const std::filesystem::path& folder);

/// The same for a name that stands in a list.
[[nodiscard]] std::filesystem::path answered_file(const nlohmann::json& name,
                                                  const std::filesystem::path& folder);

}  // namespace rnmbake
