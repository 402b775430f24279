#include "report/thresholds.h"

#include "base/error.h"
#include "base/names.h"
#include "report/finding.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace rnmbake {
namespace {

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> names{"rmse", "bias", "p95", "p99", "max"};
  return names;
}

[[noreturn]] void refuse(const std::string& word, const std::string& why) {
  fail(ExitCode::usage, "threshold '{}': {}; give for example rmse=2%,bias=0.5%", word, why);
}

double number_in(const std::string& word, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value) || value < 0)
    refuse(word, "its limit is no number from 0 on");
  return value;
}

Threshold parse_one(const std::string& word) {
  const auto equals = word.find('=');
  if (equals == std::string::npos) refuse(word, "it has no limit");
  Threshold threshold;
  threshold.metric = word.substr(0, equals);
  if (std::ranges::find(metric_names(), threshold.metric) == metric_names().end())
    refuse(word, "metrics are rmse, bias, p95, p99, max" + did_you_mean(threshold.metric, metric_names()));
  std::string limit = word.substr(equals + 1);
  threshold.relative = limit.ends_with('%');
  if (threshold.relative) limit.pop_back();
  threshold.limit = number_in(word, limit) / (threshold.relative ? 100 : 1);
  return threshold;
}

double relative(double value, double mean) {
  return value == 0 ? 0 : value / mean;
}

double value_of(const Threshold& threshold, const PictureMetrics& metrics) {
  const bool share = threshold.relative;
  if (threshold.metric == "rmse") return (share ? metrics.relative_rmse : metrics.rmse).value;
  if (threshold.metric == "bias") return std::abs((share ? metrics.relative_bias : metrics.bias).value);
  const double error = threshold.metric == "p95"   ? metrics.p95
                       : threshold.metric == "p99" ? metrics.p99
                                                   : metrics.max;
  return share ? relative(error, metrics.reference_mean) : error;
}

bool same(const Threshold& a, const Threshold& b) {
  return a.metric == b.metric && a.relative == b.relative && a.limit == b.limit;
}

/// For each object, in order, the worst basis of each threshold that it exceeds.
std::vector<std::pair<std::string, std::vector<const Exceeded*>>> worst_by_object(
    const ThresholdOutcome& outcome) {
  std::vector<std::pair<std::string, std::vector<const Exceeded*>>> objects;
  for (const Exceeded& one : outcome.exceeded) {
    if (objects.empty() || objects.back().first != one.object) objects.push_back({one.object, {}});
    auto& worst = objects.back().second;
    const auto known = std::ranges::find_if(
        worst, [&](const Exceeded* other) { return same(other->threshold, one.threshold); });
    if (known == worst.end()) {
      worst.push_back(&one);
    } else if (one.value > (*known)->value) {
      *known = &one;
    }
  }
  return objects;
}

std::string clause(const Exceeded& exceeded) {
  const auto written = [&](double value) {
    return exceeded.threshold.relative ? percent(value) : number(value);
  };
  return fmt::format("{} {} in {} is above {}", exceeded.threshold.metric, written(exceeded.value),
                     exceeded.basis, written(exceeded.threshold.limit));
}

}  // namespace

std::vector<Threshold> parse_thresholds(const std::string& text) {
  std::vector<Threshold> thresholds;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    thresholds.push_back(parse_one(text.substr(start, comma - start)));
    start = comma + 1;
  }
  return thresholds;
}

ThresholdOutcome check_thresholds(const Report& report, std::vector<Threshold> thresholds) {
  ThresholdOutcome outcome{std::move(thresholds), {}};
  for (const ObjectComparison& object : report.objects) {
    for (const Threshold& threshold : outcome.thresholds) {
      for (const BasisMetrics& basis : object.bases) {
        const double value = value_of(threshold, basis.metrics);
        if (value <= threshold.limit) continue;
        outcome.exceeded.push_back({object.key, basis.name, threshold, value});
      }
    }
  }
  return outcome;
}

std::string describe(const Threshold& threshold) {
  return fmt::format("{} {}", threshold.metric,
                     threshold.relative ? percent(threshold.limit) : number(threshold.limit));
}

std::vector<std::string> describe(const ThresholdOutcome& outcome) {
  std::vector<std::string> lines;
  for (const auto& [object, worst] : worst_by_object(outcome)) {
    std::string line = object + ":";
    for (const Exceeded* exceeded : worst) line += (line.back() == ':' ? " " : "; ") + clause(*exceeded);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace rnmbake
