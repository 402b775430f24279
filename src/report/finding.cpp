#include "report/finding.h"

#include <cmath>
#include <cstdlib>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

struct Place {
  const ObjectComparison* object = nullptr;
  const BasisMetrics* basis = nullptr;
};

Statistic negated(const Statistic& statistic) {
  return {-statistic.value, -statistic.high95, -statistic.low95};
}

double size_of(const Statistic& statistic) {
  return std::abs(statistic.value);
}

/// Basis with the largest measure; NaN (nothing to compare with) never is.
template <typename Measure>
const BasisMetrics* worst_of(const std::vector<BasisMetrics>& bases, const Measure& measure) {
  const BasisMetrics* worst = nullptr;
  for (const BasisMetrics& basis : bases) {
    const double size = measure(basis.metrics);
    if (!std::isfinite(size)) continue;
    if (worst == nullptr || size > measure(worst->metrics)) worst = &basis;
  }
  return worst;
}

double relative_rmse(const PictureMetrics& metrics) {
  return metrics.relative_rmse.value;
}
double relative_bias(const PictureMetrics& metrics) {
  return size_of(metrics.relative_bias);
}

Place worst_object(const Report& report) {
  Place worst;
  for (const ObjectComparison& object : report.objects) {
    const BasisMetrics* basis = worst_of(object.bases, relative_rmse);
    if (basis == nullptr) continue;
    if (worst.basis == nullptr || relative_rmse(basis->metrics) > relative_rmse(worst.basis->metrics))
      worst = {&object, basis};
  }
  return worst;
}

std::string bias_clause(const Report& report, const BasisMetrics& basis) {
  const Statistic& bias = basis.metrics.relative_bias;
  if (basis.metrics.too_noisy) {
    return fmt::format("{} is too noisy to tell a bias against {} ({} in {}; bake with more samples)",
                       report.candidate_label, report.reference_label, percent(bias, true), basis.name);
  }
  const bool could_be_none = bias.low95 <= 0 && bias.high95 >= 0;
  if (could_be_none) {
    return fmt::format(
        "{} shows no bias against {} that could be told from chance, the largest being {} in {}",
        report.candidate_label, report.reference_label, percent(bias, true), basis.name);
  }
  return fmt::format("{} is {} than {}, most of all in {} by {}", report.candidate_label,
                     bias.value > 0 ? "brighter" : "darker", report.reference_label, basis.name,
                     percent(bias.value < 0 ? negated(bias) : bias, false));
}

bool noise_known(const PictureMetrics& metrics) {
  return metrics.candidate_noise_known && metrics.reference_noise_known;
}

std::string error_clause(const BasisMetrics& basis) {
  return fmt::format("the error is up to {} RMS{}", percent(basis.metrics.relative_rmse, false),
                     noise_known(basis.metrics) ? " with the noise taken out" : ", noise included");
}

std::string worst_clause(const Report& report) {
  const Place worst = worst_object(report);
  if (report.objects.size() < 2 || worst.basis == nullptr) return "";
  return fmt::format("; the worst object is {} with {} in {}", worst.object->key,
                     percent(worst.basis->metrics.relative_rmse.value), worst.basis->name);
}

/// Two decimals, more where there would be nothing else, fewer from 10 on.
std::string hundredths(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(value) || size >= 1000 || size == 0) return number(value);
  return fmt::format("{:.{}f}", value, size >= 10 ? 1 : size >= 0.1 ? 2 : size >= 0.01 ? 3 : 4);
}

}  // namespace

std::string number(double value) {
  if (std::isnan(value)) return "unknown";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  if (value == 0) return "0";
  const int leading = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (leading < -5 || leading > 6) return fmt::format("{:.2e}", value);
  return fmt::format("{:.{}f}", value, std::max(0, 2 - leading));
}

std::string percent(double share) {
  return hundredths(100 * share) + " %";
}

std::string percent(const Statistic& share, bool with_sign) {
  const auto one = [&](double value) {
    return fmt::format("{}{}", with_sign && value > 0 ? "+" : "", hundredths(100 * value));
  };
  return fmt::format("{} % ({} to {})", one(share.value), one(share.low95), one(share.high95));
}

std::string finding_of(const Report& report) {
  const BasisMetrics* bias = worst_of(report.scene, relative_bias);
  const BasisMetrics* error = worst_of(report.scene, relative_rmse);
  if (report.objects.empty()) return "There was nothing to compare.";
  if (bias == nullptr || error == nullptr) {
    return fmt::format("{} is black where it could be compared, so no relative error can be given.",
                       report.reference_label);
  }
  const std::size_t count = report.objects.size();
  return fmt::format("Over {} {}, {}; {}{}.", count, count == 1 ? "object" : "objects",
                     bias_clause(report, *bias), error_clause(*error), worst_clause(report));
}

}  // namespace rnmbake
