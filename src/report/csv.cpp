#include "report/write.h"

#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

constexpr const char* header =
    "object,basis,texels,non_finite,reference_mean,bias,bias_low95,bias_high95,relative_bias,"
    "relative_bias_low95,relative_bias_high95,rmse,rmse_low95,rmse_high95,relative_rmse,relative_rmse_low95,"
    "relative_rmse_high95,p95,p99,max,max_x,max_y,candidate_noise,reference_noise,"
    "too_noisy\r\n";

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

/// Empty for values that are not finite or not known.
std::string field(double value, bool known = true) {
  return known && std::isfinite(value) ? fmt::format(",{:.9g}", value) : ",";
}

std::string fields(const Statistic& statistic) {
  return field(statistic.value) + field(statistic.low95) + field(statistic.high95);
}

std::string line(const std::string& object, const BasisMetrics& basis) {
  const PictureMetrics& m = basis.metrics;
  return fmt::format("{},{},{},{}", quoted(object), quoted(basis.name), m.texels, m.non_finite) +
         field(m.reference_mean) + fields(m.bias) + fields(m.relative_bias) + fields(m.rmse) +
         fields(m.relative_rmse) + field(m.p95) + field(m.p99) + field(m.max) +
         fmt::format(",{},{}", m.max_x, m.max_y) + field(m.candidate_noise, m.candidate_noise_known) +
         field(m.reference_noise, m.reference_noise_known) + (m.too_noisy ? ",1\r\n" : ",0\r\n");
}

}  // namespace

std::string to_csv(const Report& report) {
  std::string text = header;
  for (const ObjectComparison& object : report.objects)
    for (const BasisMetrics& basis : object.bases) text += line(object.key, basis);
  for (const BasisMetrics& basis : report.scene) text += line("(scene)", basis);
  return text;
}

}  // namespace rnmbake
