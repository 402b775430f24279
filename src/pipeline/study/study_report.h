// pipeline/study/study_report.h - what a study found, as text and as files.
#pragma once

#include "pipeline/study/encoding_study.h"
#include "pipeline/study/probe.h"
#include "pipeline/study/study_spheres.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

struct StudyReport {
  std::string title;  // what the lights are
  std::size_t lights = 0;
  std::vector<EncodingErrors> errors;
  std::optional<ProbeTable> probe;      // of the whole sphere
  std::vector<SpherePicture> pictures;  // or none
};

/// To read in a terminal.
[[nodiscard]] std::string study_text(const StudyReport& report);

/// encodings.md, encodings.json and the page encodings.html; spheres/NAME.png of the pictures, all at one
/// exposure. The folder is made where it is missing. Throws Error(io).
void write_study(const StudyReport& report, const std::filesystem::path& folder);

/// What encodings.json holds: docs/study.md.
[[nodiscard]] nlohmann::ordered_json study_json(const StudyReport& report);

}  // namespace rnmbake
