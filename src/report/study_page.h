// report/study_page.h - a study of encodings as a page: a plot of error against bytes, errors by tilt,
// pictures.
#pragma once

#include <string>
#include <vector>

namespace rnmbake {

struct StudyPicture {
  std::string label;
  double rms = 0;   // share of the truth's root mean square
  std::string png;  // the file's bytes
};

struct StudyPage {
  std::string title, finding;
  std::string figures;                 // JSON of the table: docs/study.md
  std::string probe;                   // JSON of the whole sphere's table, or ""
  std::vector<StudyPicture> pictures;  // the truth first, or none
};

/// One self-contained page. Every text is escaped.
[[nodiscard]] std::string to_html(const StudyPage& page);

}  // namespace rnmbake
