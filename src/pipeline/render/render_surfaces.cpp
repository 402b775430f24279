#include "pipeline/render/render_surfaces.h"

#include "base/error.h"
#include "image/sample.h"

#include <algorithm>
#include <array>

namespace rnmbake {
namespace {

std::array<float, 3> weights(const Vertex& vertex) {
  return {1 - vertex.b1 - vertex.b2, vertex.b1, vertex.b2};
}

/// The layer of the first normal map among an object's looks; nothing where it has none.
std::optional<std::string> normal_map_layer(const DiffuseScene& scene, std::size_t object) {
  for (const int material : scene.object_materials[object]) {
    const int map = scene.materials[static_cast<std::size_t>(material)].normal_map;
    if (map >= 0) return scene.normal_maps[static_cast<std::size_t>(map)].uv_layer;
  }
  return std::nullopt;
}

FloatImage image_of(const Texture& picture) {
  FloatImage image(picture.width, picture.height, 3);
  for (std::size_t i = 0; i < picture.texels.size(); ++i)
    std::copy_n(&picture.texels[i].x, 3, &image.data()[3 * i]);
  return image;
}

/// Strength of a normal map, as in Blender's Normal Map node.
Vec3 with_strength(const Vec3& normal, float strength) {
  const float share = std::clamp(strength, 0.0F, 1.0F);
  return {normal.x * strength, normal.y * strength, 1 + (normal.z - 1) * share};
}

}  // namespace

const std::vector<Vec2>* uv_layer(const Mesh& mesh, const std::string& name) {
  const auto& layers = mesh.uv_layers;
  if (layers.empty()) return nullptr;
  if (name.empty()) return &layers[static_cast<std::size_t>(std::max(0, mesh.render_uv))].uv;
  const auto found = std::ranges::find(layers, name, &UvLayer::name);
  return found == layers.end() ? nullptr : &found->uv;
}

RenderSurfaces::RenderSurfaces(const TraceScene& scene,
                               const std::map<std::size_t, std::string>& tangent_layers)
    : scene_(scene) {
  const DiffuseScene& diffuse_scene = scene.diffuse_scene();
  for (const NormalMap& map : diffuse_scene.normal_maps)
    normal_pictures_.push_back(image_of(diffuse_scene.pictures[static_cast<std::size_t>(map.picture)]));
  for (std::size_t i = 0; i < diffuse_scene.survey.objects.size(); ++i) {
    const SceneObject& object = diffuse_scene.survey.objects[i];
    OnObject& on = objects_.emplace_back();
    on.mirrored = object.to_world.determinant() < 0;
    std::optional<std::string> layer = normal_map_layer(diffuse_scene, i);
    if (!layer) continue;  // the smooth normal is all that counts
    if (const auto other = tangent_layers.find(i); other != tangent_layers.end()) layer = other->second;
    const Mesh& mesh = diffuse_scene.survey.mesh_of(object);
    if (mesh.uv_layers.empty()) continue;  // as in Cycles
    const std::vector<Vec2>* uv = uv_layer(mesh, *layer);
    if (uv == nullptr) {
      fail(ExitCode::invalid_input,
           "object '{}' has no UV layer '{}' for the tangents of its normal map; is this the scene that the "
           "lightmaps were made of?",
           object.key, *layer);
    }
    on.frames = tangent_frames(mesh, *uv, object.to_world);
  }
}

std::size_t RenderSurfaces::corner(const Vertex& vertex, std::size_t k) const {
  const bool swapped = objects_[object_of(vertex)].mirrored && k > 0;
  return 3 * std::size_t(source_of(vertex)) + (swapped ? 3 - k : k);
}

Vec2 RenderSurfaces::at(const Vertex& vertex, const std::vector<Vec2>& of_loops) const {
  const SceneSurvey& survey = scene_.diffuse_scene().survey;
  const Mesh& mesh = survey.mesh_of(survey.objects[object_of(vertex)]);
  const auto weight = weights(vertex);
  Vec2 sum(0, 0);
  for (std::size_t k = 0; k < 3; ++k) sum += of_loops[mesh.triangle_loops[corner(vertex, k)]] * weight[k];
  return sum;
}

Vec3 RenderSurfaces::mapped_normal(const Vertex& vertex) const {
  const DiffuseScene& scene = scene_.diffuse_scene();
  const int number = scene.materials[vertex.material].normal_map;
  if (number < 0) return {0, 0, 1};
  const NormalMap& map = scene.normal_maps[static_cast<std::size_t>(number)];
  const SceneObject& object = scene.survey.objects[object_of(vertex)];
  const std::vector<Vec2>* uv = uv_layer(scene.survey.mesh_of(object), map.uv_layer);
  if (uv == nullptr) return {0, 0, 1};  // Cycles shows the plain normal
  const FloatImage& picture = normal_pictures_[static_cast<std::size_t>(number)];
  std::array<float, 3> colour{};
  sample(picture, bilinear_taps(picture, at(vertex, *uv), Border::wrap), colour);
  const Vec3 normal = with_strength(Vec3(colour[0], colour[1], colour[2]) * 2.0F - Vec3(1), map.strength);
  const float length = normal.length();
  return length > 0 ? normal / length : Vec3(0, 0, 1);
}

Vec3 RenderSurfaces::to_world(const Vertex& vertex, const Vec3& normal) const {
  const auto& frames = objects_[object_of(vertex)].frames;
  if (!frames) return vertex.normal;
  const auto weight = weights(vertex);
  Vec3 sum(0);
  for (std::size_t k = 0; k < 3; ++k) sum += frames->corners[corner(vertex, k)].to_world(normal) * weight[k];
  const float length = sum.length();
  if (!(length > 0)) return vertex.normal;
  return sum / (vertex.back ? -length : length);
}

}  // namespace rnmbake
