#include "pipeline/study/study_report.h"

#include "base/files.h"
#include "base/names.h"
#include "base/text.h"
#include "image/display_png.h"
#include "pipeline/study/study_finding.h"
#include "report/study_page.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Stops that bring all but the brightest hundredth of the truth below 1.
float exposure_for(const FloatImage& truth) {
  std::vector<float> bright;
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x)
      if (const float most = max_channel(vec3_at(truth, x, y)); most > 0) bright.push_back(most);
  if (bright.empty()) return 0;
  const auto place = bright.begin() + std::ptrdiff_t(bright.size() * 99 / 100);
  std::ranges::nth_element(bright, place);
  return -std::log2(*place);
}

std::vector<StudyPicture> write_spheres(const std::vector<SpherePicture>& pictures, const fs::path& folder) {
  std::vector<StudyPicture> written;
  if (pictures.empty()) return written;
  make_folders(folder);
  const float exposure = exposure_for(pictures.front().pixels);
  for (const SpherePicture& picture : pictures) {
    const fs::path file = folder / (file_word(picture.label) + ".png");
    write_display_png(file, picture.pixels, exposure);
    written.push_back({picture.label, picture.rms, read_text(file)});
  }
  return written;
}

}  // namespace

std::string study_text(const StudyReport& report) {
  std::string text =
      fmt::format("RMS error, percent of the flat light, over normals tilted up to so many degrees; {}\n\n{}",
                  counted(report.lights, "light"), study_table(report.errors));
  for (const EncodingErrors& one : report.errors)
    if (!one.unfit.empty()) text += '\n' + printable(one.label) + ": " + printable(one.unfit) + '\n';
  if (report.probe)
    text += "\nE/pi of the whole sphere, at normals all around\n\n" + probe_table(*report.probe);
  const std::string finding = rnm_finding(report.errors);
  return finding.empty() ? text : text + '\n' + finding + '\n';
}

nlohmann::ordered_json study_json(const StudyReport& report) {
  nlohmann::ordered_json document = study_json(report.errors, report.lights);
  document["finding"] = rnm_finding(report.errors);
  if (report.probe) document["probe"] = probe_json(*report.probe);
  return document;
}

void write_study(const StudyReport& report, const fs::path& folder) {
  make_folders(folder);
  const StudyPage page{report.title, rnm_finding(report.errors), study_json(report),
                       write_spheres(report.pictures, folder / "spheres")};
  std::string markdown = study_markdown(report.errors);
  if (report.probe) markdown += '\n' + probe_markdown(*report.probe);
  if (!page.finding.empty()) markdown += '\n' + page.finding + '\n';
  write_atomically(folder / "encodings.md", markdown);
  write_atomically(folder / "encodings.json", page.study.dump(2) + '\n');
  write_atomically(folder / "encodings.html", to_html(page));
}

}  // namespace rnmbake
