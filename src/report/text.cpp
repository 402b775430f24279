#include "base/text.h"

#include "base/text_table.h"
#include "report/finding.h"
#include "report/write.h"

#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

using Row = TextTable::Row;

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

void write_list(const std::string& what, const std::vector<std::string>& lines, std::ostream& out) {
  for (const std::string& line : lines) out << printable(what + line) << '\n';
}

}  // namespace

std::string to_text(const Report& report) {
  std::ostringstream out;
  TextTable table;
  table.add({"object", "basis", "texels", "bias", "RMSE", "95 %", "99 %", "max"});
  for (const ObjectComparison& object : report.objects)
    for (const BasisMetrics& basis : object.bases) table.add(row_of(object.key, basis, ""));
  for (const BasisMetrics& basis : report.scene)
    table.add(row_of("(scene)", basis, worst_place(report, basis.metrics)));
  table.write(out);
  write_list("only in " + report.candidate_label + ": ", report.candidate_only, out);
  write_list("only in " + report.reference_label + ": ", report.reference_only, out);
  out << '\n' << printable(report.finding) << '\n';
  return out.str();
}

}  // namespace rnmbake
