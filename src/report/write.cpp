#include "report/write.h"

#include "base/files.h"

namespace rnmbake {

void write_report(const Report& report, const std::filesystem::path& folder) {
  make_folders(folder);
  write_atomically(folder / "report.json", to_json(report));
  write_atomically(folder / "report.csv", to_csv(report));
  write_atomically(folder / "report.html", to_html(report));
}

}  // namespace rnmbake
