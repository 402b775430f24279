#include "report/study_page.h"

#include "report/html_fill.h"
#include "report/html_parts.h"
#include "report/pack.h"

namespace rnmbake {

std::string to_html(const StudyPage& page) {
  nlohmann::ordered_json study = page.study;
  study["pictures"] = nlohmann::ordered_json::array();
  for (const StudyPicture& picture : page.pictures) {
    study["pictures"].push_back({{"label", picture.label},
                                 {"rms", picture.rms},
                                 {"source", "data:image/png;base64," + base64(picture.png)}});
  }
  return filled(embedded_files(embedded_study(), "study.html"),
                {{"head", page_head(page.title, "img-src data:; ")},
                 {"title", escaped(page.title)},
                 {"finding", unbroken(escaped(page.finding))},
                 {"study", for_script(study)},
                 {"script", embedded_files(embedded_report(), "format.js") +
                                embedded_files(embedded_report(), "charts.js") +
                                embedded_files(embedded_study(), ".js")}});
}

}  // namespace rnmbake
