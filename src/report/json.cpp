#include "base/version.h"
#include "report/document.h"
#include "report/write.h"

namespace rnmbake {
namespace {

using json = nlohmann::ordered_json;

// Named before describe_all(), which must find them all.
json describe(const ObjectComparison& object);
json describe(const Decomposition& decomposition);
json describe(const BasisDecomposition& basis);
json describe(const DecompositionRow& row);
json describe(const StudyPoint& point);
json describe(const ViewComparison& view);
json describe(const ViewPicture& picture);
json describe(const Threshold& threshold);
json describe(const Exceeded& exceeded);

json describe(const Statistic& statistic) {
  return {{"value", statistic.value}, {"low95", statistic.low95}, {"high95", statistic.high95}};
}

json noise(double value, bool known) {
  return known ? json(value) : json(nullptr);
}

json describe(const BasisMetrics& basis) {
  const PictureMetrics& m = basis.metrics;
  return {{"basis", basis.name},
          {"texels", m.texels},
          {"non_finite", m.non_finite},
          {"reference_mean", m.reference_mean},
          {"bias", describe(m.bias)},
          {"relative_bias", describe(m.relative_bias)},
          {"rmse", describe(m.rmse)},
          {"relative_rmse", describe(m.relative_rmse)},
          {"p95", m.p95},
          {"p99", m.p99},
          {"max", {{"error", m.max}, {"x", m.max_x}, {"y", m.max_y}}},
          {"too_noisy", m.too_noisy},
          {"noise",
           {{"candidate", noise(m.candidate_noise, m.candidate_noise_known)},
            {"reference", noise(m.reference_noise, m.reference_noise_known)}}}};
}

json describe_scene(const Report& report) {
  json bases = json::array();
  for (const BasisMetrics& basis : report.scene) {
    json entry = describe(basis);
    if (basis.metrics.max_picture < report.objects.size())
      entry["max"]["object"] = report.objects[basis.metrics.max_picture].key;
    bases.push_back(entry);
  }
  return bases;
}

template <typename Item>
json describe_all(const std::vector<Item>& items) {
  json list = json::array();
  for (const Item& item : items) list.push_back(describe(item));
  return list;
}

json describe(const ObjectComparison& object) {
  return {{"key", object.key},
          {"candidate_files", object.candidate_files},
          {"reference_files", object.reference_files},
          {"width", object.width},
          {"height", object.height},
          {"coverage", object.coverage},
          {"validity", object.validity},
          {"bases", describe_all(object.bases)},
          {"notes", object.notes},
          {"outside_model", object.outside_model}};
}

json describe(const DecompositionRow& row) {
  return {{"name", row.name},
          {"bias", describe(row.bias)},
          {"relative_bias", describe(row.relative_bias)},
          {"rmse", describe(row.rmse)},
          {"relative_rmse", describe(row.relative_rmse)}};
}

json describe(const BasisDecomposition& basis) {
  return {{"basis", basis.basis},
          {"reference_mean", basis.reference_mean},
          {"rows", describe_all(basis.rows)},
          {"total", describe(basis.total)}};
}

json describe(const Decomposition& decomposition) {
  return {{"subject", decomposition.subject}, {"bases", describe_all(decomposition.bases)}};
}

json describe(const BounceLimit& limit) {
  if (limit.bounces < 0) return nullptr;
  return {{"bounces", limit.bounces}, {"relative_bias", describe(limit.relative_bias)}};
}

json describe(const StudyPoint& point) {
  return {{"name", point.name},
          {"targets", point.targets},
          {"seconds", point.seconds},
          {"relative_rmse", describe(point.error)}};
}

json describe(const ViewPicture& picture) {
  json entry{{"label", picture.label}};
  if (!picture.has_error) return entry;
  entry["rmse"] = picture.rmse;
  entry["relative_rmse"] = picture.relative_rmse;
  entry["bias"] = picture.bias;
  entry["relative_bias"] = picture.relative_bias;
  return entry;
}

json describe(const ViewComparison& view) {
  return {{"name", view.name}, {"pictures", describe_all(view.pictures)}};
}

json describe(const Threshold& threshold) {
  return {{"metric", threshold.metric}, {"limit", threshold.limit}, {"relative", threshold.relative}};
}

json describe(const Exceeded& exceeded) {
  json entry = describe(exceeded.threshold);
  entry["object"] = exceeded.object;
  entry["basis"] = exceeded.basis;
  entry["value"] = exceeded.value;
  return entry;
}

/// Settings keep their order and may repeat, so they are pairs rather than an object.
json describe(const KeyValues& values) {
  json list = json::array();
  for (const auto& [key, value] : values) list.push_back({{"key", key}, {"value", value}});
  return list;
}

}  // namespace

nlohmann::ordered_json report_document(const Report& report) {
  return {{"schema_version", report_schema_version},
          {"rnmbake", version},
          {"title", report.title},
          {"finding", report.finding},
          {"candidate", report.candidate_label},
          {"reference", report.reference_label},
          {"command", report.command},
          {"settings", describe(report.settings)},
          {"versions", describe(report.versions)},
          {"scene", describe_scene(report)},
          {"objects", describe_all(report.objects)},
          {"candidate_only", report.candidate_only},
          {"reference_only", report.reference_only},
          {"notes", report.notes},
          {"not_followed", report.not_followed},
          {"bounce_limit", describe(report.bounce_limit)},
          {"decompositions", describe_all(report.decompositions)},
          {"study", describe_all(report.study.points)},
          {"views", describe_all(report.views)},
          {"thresholds",
           {{"limits", describe_all(report.thresholds.thresholds)},
            {"exceeded", describe_all(report.thresholds.exceeded)},
            {"passed", report.thresholds.exceeded.empty()}}}};
}

std::string to_json(const Report& report) {
  return report_document(report).dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace rnmbake
