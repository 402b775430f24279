#include "scene/diffuse_scene_parts.h"

#include <algorithm>

namespace rnmbake {
namespace {

using nlohmann::json;

/// Appends the bytes of an array; returns its offset.
template <typename T>
std::size_t append(const std::vector<T>& values, std::string& data) {
  const std::size_t offset = data.size();
  if (!values.empty()) data.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return offset;
}

/// Row by row for column vectors, as Blender writes it.
json store_matrix(const Mat44& matrix) {
  json values = json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) values.push_back(matrix[column][row]);
  }
  return values;
}

json store_color(const Vec3& color) {
  return {color.x, color.y, color.z};
}

json store_mesh(const Mesh& mesh, std::string& data) {
  json layers = json::array();
  json entry{{"name", mesh.name},
             {"vertices", mesh.positions.size()},
             {"loops", mesh.loop_vertex.size()},
             {"polygons", mesh.polygon_start.size()},
             {"triangles", mesh.triangles()},
             {"positions", append(mesh.positions, data)},
             {"loop_vertex", append(mesh.loop_vertex, data)},
             {"loop_normal", append(mesh.loop_normal, data)},
             {"triangle_loops", append(mesh.triangle_loops, data)},
             {"triangle_polygon", append(mesh.triangle_polygon, data)},
             {"polygon_start", append(mesh.polygon_start, data)},
             {"polygon_size", append(mesh.polygon_size, data)},
             {"polygon_slot", append(mesh.polygon_slot, data)},
             {"active_uv", mesh.active_uv},
             {"render_uv", mesh.render_uv}};
  for (const UvLayer& layer : mesh.uv_layers)
    layers.push_back({{"name", layer.name}, {"offset", append(layer.uv, data)}});
  entry["uv_layers"] = std::move(layers);
  return entry;
}

json store_object(const SceneObject& object) {
  return {{"key", object.key},
          {"name", object.name},
          {"instancer", object.instancer},
          {"type", object.type},
          {"mesh", object.mesh},
          {"matrix", store_matrix(object.to_world)},
          {"slots", object.slots},
          {"light_group", object.light_group},
          {"visible_to_camera", object.visible_to_camera}};
}

json store_light(const LightInfo& light) {
  return {{"name", light.name},
          {"type", light.type},
          {"energy", light.energy},
          {"color", light.color},
          {"shape", light.shape},
          {"max_bounces", light.max_bounces},
          {"sizes", light.sizes},
          {"matrix", store_matrix(light.to_world)},
          {"outside_model", light.outside_model}};
}

json store_survey(const SceneSurvey& survey, std::string& data) {
  json content{
      {"format", 1},
      {"byte_order", "little"},
      {"scene_file", survey.scene_file},
      {"scene_name", survey.scene_name},
      {"blender_version", survey.blender_version},
      {"warnings", survey.warnings},
      {"world", {{"kind", survey.world}, {"strength", survey.world_strength}, {"color", survey.world_color}}},
      {"meshes", json::array()},
      {"objects", json::array()},
      {"lights", json::array()},
      {"probe_places", json::array()},
      {"materials", json::object()}};
  for (const Mesh& mesh : survey.meshes) content["meshes"].push_back(store_mesh(mesh, data));
  for (const SceneObject& object : survey.objects) content["objects"].push_back(store_object(object));
  for (const LightInfo& light : survey.lights) content["lights"].push_back(store_light(light));
  for (const ProbePlace& place : survey.probe_places) {
    content["probe_places"].push_back(
        {{"name", place.name}, {"matrix", store_matrix(place.to_world)}, {"counts", place.counts}});
  }
  for (const auto& [name, material] : survey.materials) {
    content["materials"][name] = {{"normal_mapped", material.normal_mapped},
                                  {"emissive", material.emissive},
                                  {"outside_model", material.outside_model}};
  }
  return content;
}

json store_surface_material(const SurfaceMaterial& material) {
  return {{"material", material.name},
          {"albedo", store_color(material.albedo)},
          {"emission", store_color(material.emission)},
          {"transmittance", store_color(material.transmittance)},
          {"albedo_picture", material.albedo_picture},
          {"emission_picture", material.emission_picture},
          {"transmittance_picture", material.transmittance_picture},
          {"picture_uv", material.picture_uv},
          {"normal_map", material.normal_map}};
}

json store_camera(const Camera& camera) {
  return {{"name", camera.name},
          {"matrix", store_matrix(camera.to_world)},
          {"orthographic", camera.orthographic},
          {"angle_x", camera.angle_x},
          {"angle_y", camera.angle_y},
          {"width", camera.width},
          {"shift_x", camera.shift_x},
          {"shift_y", camera.shift_y},
          {"resolution_x", camera.resolution_x},
          {"resolution_y", camera.resolution_y}};
}

}  // namespace

json store_diffuse_scene(const DiffuseScene& scene, std::string& data) {
  json content = store_survey(scene.survey, data);
  json own{{"world", {{"radiance", store_color(scene.world.radiance)}, {"picture", scene.world.picture}}},
           {"camera", scene.camera ? store_camera(*scene.camera) : json()},
           {"object_looks", scene.object_materials}};
  for (const char* list : {"pictures", "picture_uvs", "normal_maps", "looks", "unlit", "outside"})
    own[list] = json::array();
  for (const Texture& picture : scene.pictures) own["pictures"].push_back(store_picture(picture, data));
  for (const auto& uvs : scene.picture_uvs)
    own["picture_uvs"].push_back({{"count", uvs.size()}, {"offset", append(uvs, data)}});
  for (const NormalMap& map : scene.normal_maps)
    own["normal_maps"].push_back(
        {{"picture", map.picture}, {"uv_layer", map.uv_layer}, {"strength", map.strength}});
  for (const SurfaceMaterial& material : scene.materials)
    own["looks"].push_back(store_surface_material(material));
  for (std::size_t i = 0; i < scene.survey.objects.size(); ++i) {
    if (!scene.takes_part(i)) own["unlit"].push_back(i);
  }
  for (const OutsideModel& outside : scene.outside)
    own["outside"].push_back(
        {{"owner", outside.owner}, {"what", outside.what}, {"untraced", outside.untraced}});
  content["exchange"] = std::move(own);
  return content;
}

}  // namespace rnmbake
