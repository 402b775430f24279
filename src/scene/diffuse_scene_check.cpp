#include "base/math.h"
#include "scene/diffuse_scene_parts.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr const char* remedy = "export the scene again";
constexpr float rounding = 1e-4F;  // of sums of colours that make 1

bool is_finite(const Vec3& color) {
  return std::isfinite(color.x) && std::isfinite(color.y) && std::isfinite(color.z);
}

bool is_share(const Vec3& color) {
  const auto is_share = [](float value) { return value >= 0 && value <= 1; };
  return is_share(color.x) && is_share(color.y) && is_share(color.z);
}

/// `none`: whether -1 is a choice.
void check_index(int index, std::size_t count, bool none, const std::string& owner, const char* what) {
  if ((none && index == -1) || (index >= 0 && static_cast<std::size_t>(index) < count)) return;
  fail(ExitCode::invalid_input, "{}: {} {} of {} does not exist; {}", owner, what, index, count, remedy);
}

void check_pictures(const DiffuseScene& scene) {
  for (std::size_t i = 0; i < scene.picture_uvs.size(); ++i) {
    const bool fine = std::all_of(scene.picture_uvs[i].begin(), scene.picture_uvs[i].end(),
                                  [](const Vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); });
    if (!fine) fail(ExitCode::invalid_input, "picture UVs {}: not all are finite; {}", i, remedy);
  }
  for (std::size_t i = 0; i < scene.normal_maps.size(); ++i) {
    const std::string owner = fmt::format("normal map {}", i);
    check_index(scene.normal_maps[i].picture, scene.pictures.size(), false, owner, "picture");
    if (!std::isfinite(scene.normal_maps[i].strength))
      fail(ExitCode::invalid_input, "{}: its strength is not finite; {}", owner, remedy);
  }
}

void check_look(const DiffuseScene& scene, const SurfaceMaterial& material) {
  const std::string owner = "material '" + material.name + "'";
  if (!is_share(material.albedo))
    fail(ExitCode::invalid_input, "{}: its albedo is not within 0 and 1; {}", owner, remedy);
  if (!is_share(material.transmittance))
    fail(ExitCode::invalid_input, "{}: its transmittance is not within 0 and 1; {}", owner, remedy);
  if (material.albedo_picture < 0 && material.transmittance_picture < 0 &&
      max_channel(material.albedo + material.transmittance) > 1 + rounding)
    fail(ExitCode::invalid_input, "{}: its albedo and transmittance together are above 1; {}", owner, remedy);
  if (!is_finite(material.emission))
    fail(ExitCode::invalid_input, "{}: its emission is not finite; {}", owner, remedy);
  check_index(material.albedo_picture, scene.pictures.size(), true, owner, "albedo picture");
  check_index(material.emission_picture, scene.pictures.size(), true, owner, "emission picture");
  check_index(material.transmittance_picture, scene.pictures.size(), true, owner, "transmittance picture");
  check_index(material.picture_uv, scene.picture_uvs.size(), true, owner, "picture UVs");
  check_index(material.normal_map, scene.normal_maps.size(), true, owner, "normal map");
  if (material.picture_uv < 0 &&
      (material.albedo_picture >= 0 || material.emission_picture >= 0 || material.transmittance_picture >= 0))
    fail(ExitCode::invalid_input, "{}: its picture has no UVs; {}", owner, remedy);
}

bool has_layer(const Mesh& mesh, const std::string& name) {
  if (name.empty()) return mesh.render_uv >= 0;
  return std::any_of(mesh.uv_layers.begin(), mesh.uv_layers.end(),
                     [&](const UvLayer& layer) { return layer.name == name; });
}

/// That the material's UVs are made for the object's mesh.
void check_fit(const DiffuseScene& scene, const SceneObject& object, const SurfaceMaterial& material) {
  const Mesh& mesh = scene.survey.mesh_of(object);
  const auto uvs = static_cast<std::size_t>(material.picture_uv),
             map = static_cast<std::size_t>(material.normal_map);
  if (material.picture_uv >= 0 && scene.picture_uvs[uvs].size() != mesh.loop_vertex.size()) {
    fail(ExitCode::invalid_input, "object '{}': {} picture UVs for {} corners; {}", object.key,
         scene.picture_uvs[uvs].size(), mesh.loop_vertex.size(), remedy);
  }
  if (material.normal_map >= 0 && !has_layer(mesh, scene.normal_maps[map].uv_layer)) {
    fail(ExitCode::invalid_input, "object '{}': no UV layer '{}' for its normal map; {}", object.key,
         scene.normal_maps[map].uv_layer, remedy);
  }
}

void check_objects(const DiffuseScene& scene) {
  const auto& objects = scene.survey.objects;
  if (scene.object_materials.size() != objects.size()) {
    fail(ExitCode::invalid_input, "materials for {} objects, but there are {}; {}",
         scene.object_materials.size(), objects.size(), remedy);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string owner = "object '" + objects[i].key + "'";
    if (scene.object_materials[i].empty())
      fail(ExitCode::invalid_input, "{}: it has no material; {}", owner, remedy);
    for (const int material : scene.object_materials[i]) {
      check_index(material, scene.materials.size(), false, owner, "material");
      check_fit(scene, objects[i], scene.materials[static_cast<std::size_t>(material)]);
    }
  }
}

void check_camera(const Camera& camera) {
  const auto between = [](double value, double low, double high) { return value > low && value < high; };
  const double determinant = camera.to_world.determinant();
  const bool fine = between(camera.resolution_x, 0, 65537) && between(camera.resolution_y, 0, 65537) &&
                    std::isfinite(determinant) && determinant != 0 && std::isfinite(camera.shift_x) &&
                    std::isfinite(camera.shift_y) &&
                    (camera.orthographic ? between(camera.width, 0, 1e30)
                                         : between(camera.angle_x, 0, pi) && between(camera.angle_y, 0, pi));
  if (!fine)
    fail(ExitCode::invalid_input, "camera '{}': its place, lens or resolution makes no view; {}", camera.name,
         remedy);
}

}  // namespace

void check_diffuse_scene(const DiffuseScene& scene) {
  check_pictures(scene);
  for (const SurfaceMaterial& material : scene.materials) check_look(scene, material);
  check_objects(scene);
  if (!is_finite(scene.world.radiance))
    fail(ExitCode::invalid_input, "world: its radiance is not finite; {}", remedy);
  check_index(scene.world.picture, scene.pictures.size(), true, "world", "picture");
  if (scene.camera) check_camera(*scene.camera);
}

}  // namespace rnmbake
