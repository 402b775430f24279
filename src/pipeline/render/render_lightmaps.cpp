#include "pipeline/render/render_lightmaps.h"

#include "bake/targets.h"
#include "bake/texel_centres.h"
#include "base/error.h"
#include "base/log.h"
#include "base/read_file.h"
#include "image/sample.h"
#include "lightmap/fill.h"
#include "pipeline/lightmaps/lightmap_folder.h"
#include "pipeline/lightmaps/manifest_file.h"
#include "pipeline/render/render_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Object of a key, and the triangles of its part.
struct Owner {
  std::size_t object = 0;
  std::vector<std::uint32_t> triangles;
};

std::vector<std::uint32_t> part_of(const Mesh& mesh, const SceneObject& object, const std::string& name) {
  using Split = ObjectSettings::Split;
  for (const Split mode : {Split::material, Split::loose}) {
    for (Part& part : split_mesh(mesh, object.slots, mode)) {
      if (part.name == name) return std::move(part.triangles);
    }
  }
  return {};
}

/// "floor" is an object, "floor/bricks" the part of one; names may hold slashes themselves.
std::optional<Owner> owner_of(const SceneSurvey& survey, const std::string& key) {
  for (std::size_t i = 0; i < survey.objects.size(); ++i) {
    if (survey.objects[i].key != key) continue;
    Owner owner{i, {}};
    for (std::uint32_t t = 0; t < survey.mesh_of(survey.objects[i]).triangles(); ++t)
      owner.triangles.push_back(t);
    return owner;
  }
  for (std::size_t i = 0; i < survey.objects.size(); ++i) {
    const SceneObject& object = survey.objects[i];
    if (!key.starts_with(object.key + "/")) continue;
    auto triangles = part_of(survey.mesh_of(object), object, key.substr(object.key.size() + 1));
    if (!triangles.empty()) return Owner{i, std::move(triangles)};
  }
  return std::nullopt;
}

/// Share of the triangles' UV area whose middle lies on or beside a covered texel. Triangles between the
/// centres of texels cover none and say nothing; 1 where all are.
double share_on_map(const Mesh& mesh, const Owner& owner, const std::vector<Vec2>& uv,
                    const FloatImage& coverage) {
  double on = 0, all = 0;
  for (const std::uint32_t t : owner.triangles) {
    std::array<Vec2, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = uv[mesh.triangle_loops[3 * std::size_t(t) + k]];
    if (!may_hold_centre(corner, {coverage.width(), coverage.height()})) continue;
    const double area = std::abs(double((corner[1] - corner[0]).cross(corner[2] - corner[0])));
    const Vec2 middle = (corner[0] + corner[1] + corner[2]) / 3;
    const auto taps = bilinear_taps(coverage, middle, Border::clamp);
    const bool covered = std::ranges::any_of(
        taps, [&](const Tap& tap) { return tap.weight > 0 && coverage.texel(tap.x, tap.y)[0] > 0; });
    all += area;
    on += covered ? area : 0;
  }
  return all > 0 ? on / all : 1;
}

PlacedLightmap place(const SceneSurvey& survey, const LightmapPlace& found, const Owner& owner) {
  const LoadedLightmap loaded = load_lightmap(found);
  const LightmapMetadata& metadata = loaded.metadata;
  const SceneObject& object = survey.objects[owner.object];
  const Mesh& mesh = survey.mesh_of(object);
  const std::vector<Vec2>* uv = metadata.uv_layer.empty() ? nullptr : uv_layer(mesh, metadata.uv_layer);
  if (uv == nullptr) {
    fail(ExitCode::invalid_input,
         "object '{}' has no UV layer '{}', which {} was made for; render the scene that was baked, or the "
         "one that the bake saved beside its lightmaps",
         object.key, metadata.uv_layer, loaded.file);
  }
  PlacedLightmap result{found.key, owner.object, uv, lightmap_of(loaded.image, metadata)};
  const FloatImage& coverage = result.lightmap.coverage;
  if (!coverage.empty() && share_on_map(mesh, owner, *uv, coverage) < 0.5) {
    fail(ExitCode::invalid_input,
         "{} does not fit object '{}': most of its faces lie where the lightmap covers nothing; was it made "
         "of another scene, or with other UVs?",
         loaded.file, object.key);
  }
  if (!coverage.empty()) {
    // Faces between the centres of texels may lie further from a covered one than the file was dilated.
    for (auto& [name, pixels] : result.lightmap.layers) dilate_everywhere(pixels, coverage);
  }
  return result;
}

}  // namespace

SceneLightmaps::SceneLightmaps(const fs::path& path, const DiffuseScene& scene) {
  const SceneSurvey& survey = scene.survey;
  const LightmapFolder folder = open_lightmaps(path);
  std::vector<std::string> elsewhere;
  for (const LightmapPlace& found : folder.places) {
    const std::optional<Owner> owner = owner_of(survey, found.key);
    if (!owner) {
      elsewhere.push_back(found.key);
      continue;
    }
    placed_.push_back(place(survey, found, *owner));
    tangent_layers_.emplace(owner->object, placed_.back().lightmap.metadata.tangent_uv_layer);
    auto& numbers = by_triangle_[owner->object];
    numbers.resize(survey.mesh_of(survey.objects[owner->object]).triangles(), -1);
    for (const std::uint32_t t : owner->triangles) numbers[t] = static_cast<int>(placed_.size()) - 1;
  }
  if (placed_.empty()) {
    fail(ExitCode::invalid_input,
         "{}: its lightmaps and {} have no object in common; give the folder that was made of this scene",
         path.string(), survey.scene_file);
  }
  if (!elsewhere.empty()) log::warn("not in the scene, left out: {}", fmt::join(elsewhere, ", "));
  for (std::size_t i = 0; i < survey.objects.size(); ++i) {
    if (scene.takes_part(i) && survey.objects[i].visible_to_camera && !by_triangle_.contains(i))
      bare_.push_back(survey.objects[i].key);
  }
}

int SceneLightmaps::find(std::size_t object, std::uint32_t triangle) const {
  const auto found = by_triangle_.find(object);
  return found == by_triangle_.end() ? -1 : found->second[triangle];
}

std::optional<std::string> SceneLightmaps::obstacle(DecodeVariant variant) const {
  for (const PlacedLightmap& one : placed_) {
    const auto why = decode_obstacle(one.lightmap.metadata, variant);
    if (why) return fmt::format("the lightmap of '{}' does not fit: {}", one.key, *why);
    try {
      (void)LightmapDecoder(one.lightmap, variant);
    } catch (const Error& error) {
      return fmt::format("'{}': {}", one.key, error.what());
    }
  }
  return std::nullopt;
}

std::vector<LightmapDecoder> SceneLightmaps::decoders(DecodeVariant variant) const {
  if (const auto why = obstacle(variant))
    fail(ExitCode::unsupported, "{} cannot be decoded: {}", name_of(variant), *why);
  std::vector<LightmapDecoder> all;
  for (const PlacedLightmap& one : placed_) all.emplace_back(one.lightmap, variant);
  return all;
}

std::optional<fs::path> scene_with_lightmap_uvs(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  if (!fs::is_regular_file(file)) return std::nullopt;
  const nlohmann::json manifest = read_manifest(file);
  const auto text = [](const nlohmann::json& owner, const char* key) {
    const auto found = owner.find(key);
    return found != owner.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto saved = file_inside(folder, text(manifest, "scene_with_uvs"));
  if (!saved || !fs::is_regular_file(*saved)) return std::nullopt;
  const auto objects = manifest.find("objects");
  const bool unwrapped =
      objects != manifest.end() && std::ranges::any_of(*objects, [](const auto& one) {
        return one.is_object() && one.find("unwrapped") != one.end() && *one.find("unwrapped") == true;
      });
  return unwrapped ? saved : std::nullopt;
}

}  // namespace rnmbake
