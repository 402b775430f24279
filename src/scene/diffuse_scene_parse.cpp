#include "base/json.h"
#include "scene/diffuse_scene_parts.h"
#include "scene/survey_parse.h"

#include <array>

namespace rnmbake {
namespace {

using nlohmann::json;

Vec3 read_color(const json& values, const std::string& owner) {
  if (!values.is_array() || values.size() != 3)
    fail(ExitCode::invalid_input, "{}: {} is no colour", owner, brief(values));
  return {values.at(0).get<float>(), values.at(1).get<float>(), values.at(2).get<float>()};
}

SurfaceMaterial read_surface_material(const json& entry) {
  SurfaceMaterial material;
  material.name = entry.at("material").get<std::string>();
  material.albedo = read_color(entry.at("albedo"), "albedo of material '" + material.name + "'");
  material.emission = read_color(entry.at("emission"), "emission of material '" + material.name + "'");
  material.albedo_picture = index_at(entry, "albedo_picture");
  material.emission_picture = index_at(entry, "emission_picture");
  material.picture_uv = index_at(entry, "picture_uv");
  material.normal_map = index_at(entry, "normal_map");
  if (const auto found = entry.find("transmittance"); found != entry.end())
    material.transmittance = read_color(*found, "transmittance of material '" + material.name + "'");
  if (entry.contains("transmittance_picture"))
    material.transmittance_picture = index_at(entry, "transmittance_picture");
  return material;
}

Camera read_camera(const json& entry) {
  Camera camera;
  camera.name = entry.at("name").get<std::string>();
  camera.to_world = read_matrix(entry.at("matrix"), "camera '" + camera.name + "'");
  camera.orthographic = entry.at("orthographic").get<bool>();
  camera.angle_x = entry.at("angle_x").get<double>();
  camera.angle_y = entry.at("angle_y").get<double>();
  camera.width = entry.at("width").get<double>();
  camera.shift_x = entry.at("shift_x").get<double>();
  camera.shift_y = entry.at("shift_y").get<double>();
  camera.resolution_x = index_at(entry, "resolution_x");
  camera.resolution_y = index_at(entry, "resolution_y");
  return camera;
}

void read_pictures(const json& content, Blob& data, DiffuseScene& scene) {
  for (const json& entry : content.at("pictures")) scene.pictures.push_back(parse_picture(entry, data));
  for (const json& entry : content.at("picture_uvs")) {
    const std::size_t number = scene.picture_uvs.size();
    scene.picture_uvs.push_back(data.cut<Vec2>(entry, "offset", count_at(entry, "count"),
                                               [number] { return fmt::format("picture UVs {}: ", number); }));
  }
  for (const json& entry : content.at("normal_maps"))
    scene.normal_maps.push_back({index_at(entry, "picture"), entry.at("uv_layer").get<std::string>(),
                                 entry.at("strength").get<float>()});
}

void read_surface_materials(const json& content, DiffuseScene& scene) {
  for (const json& entry : content.at("looks")) scene.materials.push_back(read_surface_material(entry));
  for (const json& entry : content.at("object_looks")) {
    std::vector<int>& slots = scene.object_materials.emplace_back();
    for (const json& material : entry) slots.push_back(index_of(material, "look"));
  }
  scene.unlit.assign(scene.survey.objects.size(), 0);
  for (const json& number : content.at("unlit")) {
    const auto object = static_cast<std::size_t>(index_of(number, "object"));
    if (object >= scene.unlit.size())
      fail(ExitCode::invalid_input, "unlit: there is no object {}", brief(number));
    scene.unlit[object] = 1;
  }
}

}  // namespace

DiffuseScene parse_diffuse_scene_content(const json& content, Blob& data) {
  DiffuseScene scene;
  scene.survey = parse_survey(content, data);
  const json& own = content.at("exchange");
  read_pictures(own, data, scene);
  read_surface_materials(own, scene);
  scene.world.radiance = read_color(own.at("world").at("radiance"), "world");
  scene.world.picture = index_at(own.at("world"), "picture");
  if (const json& camera = own.at("camera"); !camera.is_null()) scene.camera = read_camera(camera);
  for (const json& entry : own.at("outside"))
    scene.outside.push_back({entry.at("owner").get<std::string>(),
                             entry.at("what").get<std::vector<std::string>>(),
                             entry.value("untraced", std::vector<std::string>())});
  check_diffuse_scene(scene);
  return scene;
}

}  // namespace rnmbake
