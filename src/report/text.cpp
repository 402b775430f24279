#include "report/finding.h"
#include "report/write.h"

#include <algorithm>
#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

using Row = std::vector<std::string>;

/// Characters of UTF-8, which is near enough to what a terminal shows.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

void write_table(const std::vector<Row>& rows, std::ostream& out) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - width(row[i]) + 2, ' ');
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
}

std::string share(double error, double mean) {
  return error == 0 ? "0 %" : percent(error / mean);
}

Row row_of(const std::string& object, const BasisMetrics& basis, const std::string& place) {
  const PictureMetrics& m = basis.metrics;
  if (m.texels == 0) return {object, basis.name, "0", "-", "-", "-", "-", "-"};
  return {object,
          basis.name,
          std::to_string(m.texels),
          percent(m.relative_bias, true) + (m.too_noisy ? ", too noisy to tell" : ""),
          percent(m.relative_rmse, false),
          share(m.p95, m.reference_mean),
          share(m.p99, m.reference_mean),
          fmt::format("{} at {}{},{}", share(m.max, m.reference_mean), place, m.max_x, m.max_y)};
}

std::string worst_place(const Report& report, const PictureMetrics& metrics) {
  return metrics.max_picture < report.objects.size() ? report.objects[metrics.max_picture].key + " " : "";
}

void write_list(const char* what, const std::vector<std::string>& lines, std::ostream& out) {
  for (const std::string& line : lines) out << what << line << '\n';
}

}  // namespace

std::string to_text(const Report& report) {
  std::ostringstream out;
  std::vector<Row> rows{{"object", "basis", "texels", "bias", "RMSE", "95 %", "99 %", "max"}};
  for (const ObjectComparison& object : report.objects)
    for (const BasisMetrics& basis : object.bases) rows.push_back(row_of(object.key, basis, ""));
  for (const BasisMetrics& basis : report.scene)
    rows.push_back(row_of("(scene)", basis, worst_place(report, basis.metrics)));
  write_table(rows, out);
  write_list(("only in " + report.candidate_label + ": ").c_str(), report.candidate_only, out);
  write_list(("only in " + report.reference_label + ": ").c_str(), report.reference_only, out);
  out << '\n' << report.finding << '\n';
  return out.str();
}

}  // namespace rnmbake
