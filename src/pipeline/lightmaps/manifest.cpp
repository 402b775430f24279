#include "pipeline/lightmaps/manifest.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "config/recipe_names.h"
#include "pipeline/lightmaps/left_files.h"
#include "pipeline/lightmaps/target_facts.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json to_json(const MergeCounts& counts) {
  return {{"covered", counts.covered_texels}, {"black", counts.black},
          {"non_finite", counts.non_finite},  {"fireflies", counts.fireflies},
          {"repaired", counts.repaired},      {"beyond_half", counts.beyond_half},
          {"negative", counts.negative},      {"unscalable", counts.unscalable}};
}

json to_json(const HorizonCounts& counts, const std::string& treatment) {
  return {{"treatment", treatment},
          {"corners", counts.corners},
          {"corners_below", counts.corners_below},
          {"triangles", counts.triangles},
          {"triangles_below", counts.triangles_below}};
}

json uv_json(const Target& target) {
  const UvReport& report = target.uv_report;
  return {
      {"overlap_texels", report.overlap_texels},         {"outside_texels", report.outside_texels},
      {"udim_triangles", report.tile_triangles},         {"degenerate_uv_triangles", report.degenerate_uv},
      {"degenerate_triangles", report.degenerate_world}, {"doubled_triangles", report.doubled},
      {"wanted_resolution", target.wanted_side}};
}

json timings_of(const BakeRecord& bake) {
  const BakeTimings& timings = bake.timings;
  return {{"launches", timings.launches},
          {"failed_launches", timings.failed_launches},
          {"wall_seconds", timings.wall_seconds},
          {"launch_seconds", timings.launch_seconds},
          {"prepare_seconds", timings.prepare_seconds},
          {"bake_seconds", timings.bake_seconds},
          {"save_seconds", timings.save_seconds},
          {"peak_bytes", timings.peak_bytes}};
}

json timings_of(const ReferenceRecord& reference) {
  std::int64_t rays = 0;
  for (const auto& traced : reference.traced) rays += traced.rays;
  return {{"wall_seconds", reference.wall_seconds}, {"rays", rays}};
}

void add_to_object(const BakeRecord& bake, const ManifestInput& input, std::size_t index, json& entry) {
  const LightmapMetadata& metadata = input.headers[index].metadata;
  const auto& delivery = input.deliveries[index];
  const auto* delivered = delivery ? std::get_if<Delivered>(&*delivery) : nullptr;
  if (delivered != nullptr && delivered->standard_error > 0)
    entry["standard_error"] = delivered->standard_error;
  entry["horizon"] = to_json(bake.horizons[index], metadata.horizon);
  entry["receiver_height"] = bake.heights[index];
}

void add_to_object(const ReferenceRecord& reference, const ManifestInput& input, std::size_t index,
                   json& entry) {
  const std::string owner = "object '" + input.survey.objects[input.list.targets[index].object].key + "'";
  for (const OutsideModel& outside : reference.outside) {
    if (outside.owner != owner) continue;
    for (const std::string& what : outside.what) entry["outside_model"].push_back(what);
  }
  if (entry["status"] != "baked") return;
  entry["paths"] = reference.traced[index].paths;
  entry["standard_error"] = reference.traced[index].error;
}

/// Index of the lightmap's layer in the user's scene; -1: unwrapped, not in it.
int index_in_source(const Target& target, const Mesh& mesh) {
  const auto found = std::ranges::find(mesh.uv_layers, target.uv_layer, &UvLayer::name);
  return target.unwrapped ? -1 : static_cast<int>(found - mesh.uv_layers.begin());
}

json describe_object(const ManifestInput& input, std::size_t index) {
  const Target& target = input.list.targets[index];
  const SceneObject& object = input.survey.objects[target.object];
  const LightmapMetadata& metadata = input.headers[index].metadata;
  json entry{{"key", target.key},
             {"object", object.name},
             {"part", target.part.name},
             {"width", target.width},
             {"height", target.height},
             {"triangles", target.part.triangles.size()},
             {"uv_layer", target.uv_layer},
             {"uv_index_in_source", index_in_source(target, input.survey.mesh_of(object))},
             {"uv_hash", uv_hash(*target.uv)},
             {"mesh_hash", mesh_hash(input.survey.mesh_of(object))},
             {"unwrapped", target.unwrapped},
             {"uv", uv_json(target)},
             {"tangent_uv_layer", target.tangent_layer},
             {"green", name_of(metadata.green)},
             {"samples", metadata.samples},
             {"seed", metadata.seed}};
  const auto& delivery = input.deliveries[index];
  if (const auto* delivered = delivery ? std::get_if<Delivered>(&*delivery) : nullptr) {
    entry["status"] = "baked";
    entry["files"] = delivered->files;
    entry["samples"] = delivered->samples;
    entry["hashes"] = delivered->hashes;
    entry["texels"] = to_json(delivered->counts);
    entry["coverage"] = double(delivered->counts.covered_texels) / (double(target.width) * target.height);
  } else {
    entry["status"] = "failed";
    entry["files"] = json::array();
    entry["hashes"] = json::array();
    entry["error"] = delivery ? std::get<NotDelivered>(*delivery).reason : "not baked";
  }
  std::visit([&](const auto& record) { add_to_object(record, input, index, entry); }, input.record);
  return entry;
}

const char* name_of(SceneSettings::Materials materials) {
  return materials == SceneSettings::Materials::lambert ? "lambert" : "full";
}

void add_to_top(const BakeRecord& bake, const BakeSettings& settings, json& manifest) {
  manifest["kind"] = "bake";
  manifest["engine"] = name_of(BakingSettings::Engine::cycles);
  manifest["materials"] = name_of(settings.scene.materials);
  manifest["dispatch"] = bake.dispatch;
}

void add_to_top(const ReferenceRecord& reference, const BakeSettings& /*settings*/, json& manifest) {
  manifest["kind"] = reference.is_bake ? "bake" : "reference";
  manifest["materials"] = name_of(SceneSettings::Materials::lambert);
  if (reference.is_bake) {
    manifest["engine"] = name_of(BakingSettings::Engine::embree);
  } else {
    manifest["model"] = reference.model;
    manifest["faults"] = reference.faults;
    manifest["error"] = reference.error;
  }
  manifest["outside_model"] = json::array();
  for (const OutsideModel& outside : reference.outside)
    manifest["outside_model"].push_back(
        {{"owner", outside.owner}, {"what", outside.what}, {"untraced", outside.untraced}});
}

/// Object and UV layer of a lightmap in the saved scene; "" and -1 where that was not saved.
void add_place(const SavedScene& saved, std::size_t object, json& entry) {
  const auto found = saved.objects.find(object);
  const SavedPlace place = found == saved.objects.end() ? SavedPlace{} : found->second;
  entry["object_in_scene"] = place.object;
  entry["uv_index"] = place.uv_index;
}

json list_objects(const ManifestInput& input) {
  std::vector<std::pair<std::size_t, json>> all;
  for (std::size_t i = 0; i < input.list.targets.size(); ++i) {
    all.emplace_back(input.list.targets[i].object, describe_object(input, i));
    add_place(input.saved, input.list.targets[i].object, all.back().second);
  }
  for (const EarlierLightmap& one : input.earlier.kept) {
    all.emplace_back(one.object, one.entry);
    if (!input.saved.file.empty()) add_place(input.saved, one.object, all.back().second);
  }
  std::ranges::stable_sort(all, {}, &std::pair<std::size_t, json>::first);
  json list = json::array();
  for (auto& [object, entry] : all) list.push_back(std::move(entry));
  return list;
}

json list_skipped(const ManifestInput& input) {
  json list = json::array();
  for (const Skipped& skipped : input.list.skipped) {
    const bool kept = std::ranges::any_of(input.earlier.kept, [&](const EarlierLightmap& one) {
      return input.survey.objects[one.object].key == skipped.key;
    });
    if (!kept) list.push_back({{"key", skipped.key}, {"reason", skipped.reason}});
  }
  return list;
}

std::string saved_file(const ManifestInput& input) {
  const bool earlier = input.saved.file.empty() && !input.earlier.kept.empty();
  return earlier ? input.earlier.scene_with_uvs : input.saved.file;
}

}  // namespace

nlohmann::json make_manifest(const ManifestInput& input) {
  const LightmapMetadata common = input.headers.empty() ? LightmapMetadata{} : input.headers.front().metadata;
  json manifest{{"schema_version", manifest_schema_version},
                {"rnmbake", common.rnmbake_version},
                {"blender", input.survey.blender_version},
                {"scene", input.settings.scene.file.filename().string()},
                {"scene_with_uvs", saved_file(input)},
                {"conventions",
                 {{"encoding", common.convention},
                  {"units", common.units},
                  {"space", common.space},
                  {"handedness", common.handedness},
                  {"normalize", name_of(common.normalize)},
                  {"footprint", common.footprint}}},
                {"bases", to_json(input.bases)},
                {"recipe", common.recipe},
                {"bounces", common.bounces},
                {"warnings", input.survey.warnings},
                {"objects", list_objects(input)},
                {"skipped", list_skipped(input)}};
  std::visit([&](const auto& record) { add_to_top(record, input.settings, manifest); }, input.record);
  return manifest;
}

void write_manifest(const ManifestInput& input) {
  const fs::path& dir = input.settings.output.dir;
  const json timings = std::visit([](const auto& record) { return timings_of(record); }, input.record);
  write_atomically(dir / "timings.json", timings.dump(2) + "\n");
  const fs::path file = dir / "manifest.json";
  const json before = fs::is_regular_file(file) ? json_or_null(read_text(file)) : json();
  const json now = make_manifest(input);
  write_atomically(file, now.dump(2) + "\n");
  note_left_files(dir, before, now, input.survey);
}

}  // namespace rnmbake
