// scene/survey_parse.h - a survey from its JSON and its binary part in memory (docs/survey-format.md).
#pragma once

#include "scene/blob.h"
#include "scene/survey.h"

#include <filesystem>

namespace rnmbake {

/// Checks as read_survey() does, the format's number included. Throws nlohmann's exceptions, too.
[[nodiscard]] SceneSurvey parse_survey(const nlohmann::json& content, Blob& data);

/// The files of a launch's answer or a survey: [{"kind", "path", "there"}].
[[nodiscard]] std::vector<InputFile> read_inputs(const nlohmann::json& list);

/// The digest in a launch's answer or a survey: [{"what", "hash", "uses"}]. Throws Error(invalid_input) for a
/// part that is there twice.
[[nodiscard]] SceneDigest read_digest(const nlohmann::json& list);
[[nodiscard]] nlohmann::json to_json(const SceneDigest& digest);

/// The binary part that `content` names; beside it, and nowhere else.
[[nodiscard]] std::filesystem::path data_file(const nlohmann::json& content,
                                              const std::filesystem::path& folder);

/// The 16 numbers of Blender's matrix, row by row, for column vectors. `owner`: "light 'Lamp'".
[[nodiscard]] Mat44 read_matrix(const nlohmann::json& values, const std::string& owner);

/// Reads and checks sizes, indices and finiteness. Throws Error(io) where a file cannot be read, and
/// Error(invalid_input) naming the object and what is wrong; an object whose mesh has a NaN or infinite
/// position, UV or matrix is named with its first bad element.
[[nodiscard]] SceneSurvey read_survey(const std::filesystem::path& json_file);

}  // namespace rnmbake
