// report/write.h - a report as a page and a table to read, as JSON and as CSV for programs (docs/report.md).
#pragma once

#include "report/comparison.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace rnmbake {

/// Raised when a reader of the old form would misunderstand the new one.
inline constexpr int report_schema_version = 1;

/// A table to read in a terminal, relative to the reference's mean, and the finding.
[[nodiscard]] std::string to_text(const Report& report);

/// All numbers, no pictures: docs/report.schema.json. Numbers that are not finite become null.
[[nodiscard]] std::string to_json(const Report& report);

/// One line for each object and basis, then the scene's; RFC 4180 with a header line.
[[nodiscard]] std::string to_csv(const Report& report);

struct HtmlOptions {
  std::size_t most_bytes = 28'000'000;        // maps are scaled down until the page is no larger
  int largest_map = 256, largest_view = 960;  // texels along the longer side
};

/// One self-contained page. Every text of the report is escaped.
[[nodiscard]] std::string to_html(const Report& report, const HtmlOptions& options = {});

/// report.html, report.json and report.csv in `folder`, which is made where it is missing.
void write_report(const Report& report, const std::filesystem::path& folder);

}  // namespace rnmbake
