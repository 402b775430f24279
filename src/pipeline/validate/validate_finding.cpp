#include "pipeline/validate/validate_finding.h"

#include "base/text.h"
#include "encoding/encodings.h"
#include "report/finding.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

constexpr double least_reported = 0.001;  // of the mean; smaller causes are left to the table
constexpr double as_good_as_none = 0.003;

/// Mean over bases. The interval is that of errors which go together, i.e. rather too wide.
Statistic mean(const std::vector<Statistic>& all) {
  Statistic sum;
  for (const Statistic& one : all) {
    sum.value += one.value / double(all.size());
    sum.low95 += one.low95 / double(all.size());
    sum.high95 += one.high95 / double(all.size());
  }
  return sum;
}

/// Whether a bias is larger than as_good_as_none and than four standard errors, which chance hardly exceeds
/// among some hundred biases.
bool is_off(const Statistic& bias) {
  const double four_errors = (bias.high95 - bias.low95) / 2 / 1.96 * 4;
  return std::abs(bias.value) > as_good_as_none && std::abs(bias.value) > four_errors;
}

bool is_off(const PictureMetrics& metrics) {
  return !metrics.too_noisy && is_off(metrics.relative_bias);
}

/// The bases that a recipe is judged by: a flat bake needs none.
template <typename T, typename Name>
std::vector<const T*> directional(const std::vector<T>& bases, Name name) {
  std::vector<const T*> chosen;
  for (const T& basis : bases) {
    if (name(basis) != flat_layers.front()) chosen.push_back(&basis);
  }
  if (chosen.empty()) {
    for (const T& basis : bases) chosen.push_back(&basis);
  }
  return chosen;
}

using Causes = std::vector<std::pair<std::string, Statistic>>;

Causes causes_of(const std::vector<const BasisDecomposition*>& bases) {
  std::vector<std::pair<std::string, std::vector<Statistic>>> collected;
  for (const BasisDecomposition* basis : bases) {
    for (const DecompositionRow& row : basis->rows) {
      auto found = std::ranges::find(collected, row.name, &decltype(collected)::value_type::first);
      if (found == collected.end()) found = collected.insert(collected.end(), {row.name, {}});
      found->second.push_back(row.relative_bias);
    }
  }
  Causes causes;
  for (const auto& [name, values] : collected) causes.emplace_back(name, mean(values));
  return causes;
}

/// "light 'Lamp': node tree" and how many more.
std::string named(const std::vector<std::string>& not_followed) {
  if (not_followed.size() == 1) return not_followed.front();
  return fmt::format("{} and {} more", not_followed.front(), not_followed.size() - 1);
}

std::string named(const BounceLimit& limit) {
  if (limit.bounces < 0 || std::abs(limit.relative_bias.value) < least_reported) return "";
  return fmt::format("; the bounce limit of {} costs {:+.1f} %", limit.bounces,
                     100 * limit.relative_bias.value);
}

}  // namespace

Statistic scene_bias(const Report& report) {
  std::vector<Statistic> biases;
  biases.reserve(report.scene.size());
  for (const BasisMetrics& basis : report.scene) biases.push_back(basis.metrics.relative_bias);
  return mean(biases);
}

std::string receiver_finding(const Report& receiver) {
  const ObjectComparison* worst = nullptr;
  double largest = 0;
  std::size_t off = 0, too_noisy = 0;
  for (const ObjectComparison& object : receiver.objects) {
    double own = 0;
    for (const BasisMetrics& basis : object.bases) {
      const double bias = basis.metrics.relative_bias.value;
      if (is_off(basis.metrics) && std::abs(bias) > std::abs(own)) own = bias;
    }
    too_noisy += std::ranges::any_of(object.bases, [](const auto& one) { return one.metrics.too_noisy; });
    if (own == 0) continue;
    ++off;
    if (worst == nullptr || std::abs(own) > std::abs(largest)) worst = &object;
    if (worst == &object) largest = own;
  }
  if (receiver.objects.empty()) return "receiver: nothing was compared";
  const std::string limit = named(receiver.bounce_limit);
  const std::string objects = counted(receiver.objects.size(), "object");
  const std::string unsure = too_noisy == 0
                                 ? ""
                                 : fmt::format("; {} of {} {} too noisy to tell, bake with more samples",
                                               too_noisy, objects, too_noisy == 1 ? "is" : "are");
  if (worst == nullptr)
    return fmt::format("receiver: no bias beyond the noise ({} over the scene){}{}",
                       percent(scene_bias(receiver), true), limit, unsure);
  const std::string most =
      fmt::format("beyond the noise, most of all {} ({:+.1f} %)", worst->key, 100 * largest);
  const auto& beyond = receiver.not_followed;
  if (beyond.empty())
    return fmt::format("receiver: {} of {} {} a bias {}{}{}", off, objects, off == 1 ? "has" : "have", most,
                       limit, unsure);
  return fmt::format("receiver: not followed by the reference: {}; {} of {} {} {}{}{}", named(beyond), off,
                     objects, off == 1 ? "differs" : "differ", most, limit, unsure);
}

std::string recipe_finding(const Decomposition& scene, const std::vector<std::string>& not_followed) {
  const auto bases = directional(scene.bases, [](const BasisDecomposition& basis) { return basis.basis; });
  if (bases.empty()) return "flat-normal-map: nothing was compared";
  std::vector<Statistic> totals;
  totals.reserve(bases.size());
  for (const BasisDecomposition* basis : bases) totals.push_back(basis->total.relative_bias);
  Causes causes = causes_of(bases);
  Statistic residual;
  std::erase_if(causes, [&](const auto& cause) {
    if (cause.first == "residual") residual = cause.second;
    return cause.first == "residual" || cause.first == "noise" ||
           std::abs(cause.second.value) < least_reported;
  });
  std::ranges::stable_sort(causes, std::ranges::greater{},
                           [](const auto& cause) { return std::abs(cause.second.value); });
  std::string reported_causes;
  for (const auto& [name, value] : causes)
    reported_causes +=
        fmt::format("{}{} {:+.1f} %", reported_causes.empty() ? "" : ", ", name, 100 * value.value);
  const bool followed = not_followed.empty() || !is_off(residual);
  return fmt::format("flat-normal-map: {:+.1f} % on average{}{}; {} {}", 100 * mean(totals).value,
                     reported_causes.empty() ? "" : ", from ", reported_causes,
                     followed ? "unexplained" : "not followed by the reference", percent(residual, true));
}

}  // namespace rnmbake
