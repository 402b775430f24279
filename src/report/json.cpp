#include "base/version.h"
#include "report/document.h"
#include "report/write.h"

namespace rnmbake {
namespace {

using json = nlohmann::ordered_json;

// Named before json_list(), which must find them all.
json json_of(const ObjectComparison& object);
json json_of(const Decomposition& decomposition);
json json_of(const BasisDecomposition& basis);
json json_of(const DecompositionRow& row);
json json_of(const StudyPoint& point);
json json_of(const ViewComparison& view);
json json_of(const ViewPicture& picture);
json json_of(const Threshold& threshold);
json json_of(const Exceeded& exceeded);

json json_of(const Statistic& statistic) {
  return {{"value", statistic.value}, {"low95", statistic.low95}, {"high95", statistic.high95}};
}

json noise(double value, bool known) {
  return known ? json(value) : json(nullptr);
}

json json_of(const BasisMetrics& basis) {
  const PictureMetrics& m = basis.metrics;
  return {{"basis", basis.name},
          {"texels", m.texels},
          {"non_finite", m.non_finite},
          {"reference_mean", m.reference_mean},
          {"bias", json_of(m.bias)},
          {"relative_bias", json_of(m.relative_bias)},
          {"rmse", json_of(m.rmse)},
          {"relative_rmse", json_of(m.relative_rmse)},
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
    json entry = json_of(basis);
    if (basis.metrics.max_picture < report.objects.size())
      entry["max"]["object"] = report.objects[basis.metrics.max_picture].key;
    bases.push_back(entry);
  }
  return bases;
}

template <typename Item>
json json_list(const std::vector<Item>& items) {
  json list = json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

json json_of(const ObjectComparison& object) {
  return {{"key", object.key},
          {"candidate_files", object.candidate_files},
          {"reference_files", object.reference_files},
          {"width", object.width},
          {"height", object.height},
          {"coverage", object.coverage},
          {"validity", object.validity},
          {"bases", json_list(object.bases)},
          {"notes", object.notes},
          {"outside_model", object.outside_model}};
}

json json_of(const DecompositionRow& row) {
  return {{"name", row.name},
          {"bias", json_of(row.bias)},
          {"relative_bias", json_of(row.relative_bias)},
          {"rmse", json_of(row.rmse)},
          {"relative_rmse", json_of(row.relative_rmse)}};
}

json json_of(const BasisDecomposition& basis) {
  return {{"basis", basis.basis},
          {"reference_mean", basis.reference_mean},
          {"rows", json_list(basis.rows)},
          {"total", json_of(basis.total)}};
}

json json_of(const Decomposition& decomposition) {
  return {{"subject", decomposition.subject}, {"bases", json_list(decomposition.bases)}};
}

json json_of(const BounceLimit& limit) {
  if (limit.bounces < 0) return nullptr;
  return {{"bounces", limit.bounces}, {"relative_bias", json_of(limit.relative_bias)}};
}

json json_of(const StudyPoint& point) {
  return {{"name", point.name},
          {"targets", point.targets},
          {"seconds", point.seconds},
          {"relative_rmse", json_of(point.error)}};
}

json json_of(const ViewPicture& picture) {
  json entry{{"label", picture.label}};
  if (picture.bytes > 0) {
    entry["bytes"] = picture.bytes;
    entry["bytes_of"] = picture.by_probes ? "probe" : "texel";
  }
  if (!picture.has_error) return entry;
  entry["rmse"] = picture.rmse;
  entry["relative_rmse"] = picture.relative_rmse;
  entry["bias"] = picture.bias;
  entry["relative_bias"] = picture.relative_bias;
  return entry;
}

json json_of(const ViewComparison& view) {
  return {{"name", view.name}, {"pictures", json_list(view.pictures)}};
}

json json_of(const Threshold& threshold) {
  return {{"metric", threshold.metric}, {"limit", threshold.limit}, {"relative", threshold.relative}};
}

json json_of(const Exceeded& exceeded) {
  json entry = json_of(exceeded.threshold);
  entry["object"] = exceeded.object;
  entry["basis"] = exceeded.basis;
  entry["value"] = exceeded.value;
  return entry;
}

/// Settings keep their order and may repeat, so they are pairs rather than an object.
json json_of(const KeyValues& values) {
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
          {"settings", json_of(report.settings)},
          {"versions", json_of(report.versions)},
          {"scene", describe_scene(report)},
          {"objects", json_list(report.objects)},
          {"candidate_only", report.candidate_only},
          {"reference_only", report.reference_only},
          {"notes", report.notes},
          {"not_followed", report.not_followed},
          {"bounce_limit", json_of(report.bounce_limit)},
          {"decompositions", json_list(report.decompositions)},
          {"study", json_list(report.study.points)},
          {"views", json_list(report.views)},
          {"thresholds",
           {{"limits", json_list(report.thresholds.thresholds)},
            {"exceeded", json_list(report.thresholds.exceeded)},
            {"passed", report.thresholds.exceeded.empty()}}}};
}

std::string to_json(const Report& report) {
  return report_document(report).dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace rnmbake
