// A report with plain numbers, for tests.
#pragma once

#include "report/comparison.h"

#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

inline Statistic about(double value, double reach) {
  return {value, value - reach, value + reach};
}

/// Reference mean 2, so that absolute numbers are twice the relative ones.
inline BasisMetrics basis_of(const std::string& name, double relative_bias, double relative_rmse) {
  BasisMetrics basis{name, {}};
  PictureMetrics& m = basis.metrics;
  m.texels = 100;
  m.reference_mean = 2;
  m.relative_bias = about(relative_bias, 0.001);
  m.bias = about(2 * relative_bias, 0.002);
  m.relative_rmse = about(relative_rmse, 0.001);
  m.rmse = about(2 * relative_rmse, 0.002);
  m.p95 = 0.2;
  m.p99 = 0.4;
  m.max = 1;
  m.max_x = 3;
  m.max_y = 4;
  return basis;
}

inline Report report_of(const std::vector<std::pair<std::string, std::vector<BasisMetrics>>>& objects) {
  Report report;
  report.title = std::string("A against B");
  report.candidate_label = std::string("A");
  report.reference_label = std::string("B");
  for (const auto& [key, bases] : objects) {
    ObjectComparison object;
    object.key = key;
    object.width = object.height = 10;
    object.bases = bases;
    report.objects.push_back(std::move(object));
  }
  if (!report.objects.empty()) report.scene = report.objects.front().bases;
  return report;
}

}  // namespace rnmbake
