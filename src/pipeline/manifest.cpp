#include "pipeline/manifest.h"

#include <filesystem>

namespace rnmbake {
namespace {

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

json to_json(const BakeTimings& timings) {
  return {{"launches", timings.launches},
          {"failed_launches", timings.failed_launches},
          {"wall_seconds", timings.wall_seconds},
          {"launch_seconds", timings.launch_seconds},
          {"prepare_seconds", timings.prepare_seconds},
          {"bake_seconds", timings.bake_seconds},
          {"save_seconds", timings.save_seconds},
          {"peak_bytes", timings.peak_bytes}};
}

json describe_object(const ManifestInput& input, std::size_t index) {
  const Target& target = input.list.targets[index];
  const SceneObject& object = input.survey.objects[target.object];
  const LightmapMetadata& metadata = input.notes[index].metadata;
  json entry{{"key", target.key},
             {"object", object.name},
             {"part", target.part.name},
             {"width", target.width},
             {"height", target.height},
             {"triangles", target.part.triangles.size()},
             {"uv_layer", target.uv_layer},
             {"unwrapped", target.unwrapped},
             {"tangent_uv_layer", target.tangent_layer},
             {"green", name_of(metadata.green)},
             {"samples", metadata.samples},
             {"seed", metadata.seed},
             {"horizon", to_json(input.horizons[index], metadata.horizon)}};
  const auto& delivery = input.deliveries[index];
  if (const auto* delivered = delivery ? std::get_if<Delivered>(&*delivery) : nullptr) {
    entry["status"] = "baked";
    entry["files"] = delivered->files;
    entry["texels"] = to_json(delivered->counts);
    entry["coverage"] = double(delivered->counts.covered_texels) / (double(target.width) * target.height);
  } else {
    entry["status"] = "failed";
    entry["files"] = json::array();
    entry["error"] = delivery ? std::get<NotDelivered>(*delivery).reason : "not baked";
  }
  return entry;
}

json describe_bases(const std::vector<BasisDirection>& bases) {
  json list = json::array();
  for (const BasisDirection& basis : bases) {
    list.push_back(
        {{"name", basis.name}, {"direction", {basis.direction.x, basis.direction.y, basis.direction.z}}});
  }
  return list;
}

}  // namespace

nlohmann::json make_manifest(const ManifestInput& input) {
  const LightmapMetadata common = input.notes.empty() ? LightmapMetadata{} : input.notes.front().metadata;
  json manifest{
      {"schema_version", manifest_schema_version},
      {"rnmbake", common.rnmbake_version},
      {"blender", input.survey.blender_version},
      {"scene", input.settings.scene.file.filename().string()},
      {"scene_with_uvs", input.scene_with_uvs},
      {"conventions",
       {{"encoding", common.convention},
        {"units", common.units},
        {"space", common.space},
        {"handedness", common.handedness},
        {"normalize", name_of(common.normalize)},
        {"footprint", common.footprint}}},
      {"bases", describe_bases(input.bases)},
      {"recipe", common.recipe},
      {"materials", input.settings.scene.materials == SceneSettings::Materials::lambert ? "lambert" : "full"},
      {"dispatch", input.dispatch},
      {"bounces", common.bounces},
      {"objects", json::array()},
      {"skipped", json::array()},
      {"timings", to_json(input.timings)}};
  for (std::size_t i = 0; i < input.list.targets.size(); ++i)
    manifest["objects"].push_back(describe_object(input, i));
  for (const Skipped& skipped : input.list.skipped) {
    manifest["skipped"].push_back({{"key", skipped.key}, {"reason", skipped.reason}});
  }
  return manifest;
}

}  // namespace rnmbake
