// report/study_page.h - a study of encodings as a page: a plot of error against bytes, errors by tilt,
// pictures.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

struct StudyPicture {
  std::string label;
  double rms = 0;   // share of the truth's root mean square
  std::string png;  // the file's bytes
};

struct StudyPage {
  std::string title, finding;
  nlohmann::ordered_json study;        // what encodings.json holds: docs/study.md
  std::vector<StudyPicture> pictures;  // the truth first, or none
};

/// One self-contained page. Every text is escaped.
[[nodiscard]] std::string to_html(const StudyPage& page);

}  // namespace rnmbake
