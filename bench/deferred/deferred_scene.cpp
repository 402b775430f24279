#include "deferred_scene.h"

#include "base/error.h"
#include "image/sample.h"
#include "pipeline/render/render_gbuffer.h"
#include "pipeline/render/render_surfaces.h"
#include "pipeline/render/render_view.h"
#include "ssbump/heights/height_shadows.h"
#include "ssbump/map/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

/// Of a relief on a flat face under one light, over the whole pattern.
struct ReliefShadows {
  FloatImage truth, forward;
};

ReliefShadows shadows_of(const HeightField& field, const Vec3& light) {
  const FloatImage normals = height_normals(field, 0, field.height());
  return {height_shadows(field, light), normal_shadows(normals, light, {})};
}

float sampled(const FloatImage& image, const Vec2& uv) {
  std::array<float, 1> value{};
  sample(image, bilinear_taps(image, uv, Border::wrap), value);
  return value[0];
}

Vec3 in_camera(const Mat44& to_camera, const Vec3& direction) {
  Vec3d result;
  to_camera.multDirMatrix(Vec3d(direction), result);
  return Vec3(result);
}

}  // namespace

Reliefs read_reliefs(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) fail(ExitCode::io, "cannot read {}", file.string());
  Reliefs reliefs;
  const auto by_object = nlohmann::json::parse(stream);
  for (const auto& [name, rows] : by_object.items()) {
    const auto side = static_cast<int>(rows.size());
    FloatImage heights(side, side, 1);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) heights.texel(x, y)[0] = rows[std::size_t(y)][std::size_t(x)];
    reliefs[name] = {std::move(heights)};
  }
  return reliefs;
}

DeferredScene::DeferredScene(const std::filesystem::path& file, Reliefs reliefs, const std::string& character,
                             int width, int height)
    : scene_(read_diffuse_scene(file)), reliefs_(std::move(reliefs)) {
  options_.width = width;
  options_.height = height;
  traced_ = std::make_unique<TraceScene>(scene_, scene_.survey.blender_version);
  auto& objects = scene_.survey.objects;
  const auto found = std::ranges::find(objects, character, &SceneObject::key);
  if (found == objects.end()) fail(ExitCode::invalid_input, "no object '{}' in {}", character, file.string());
  character_ = static_cast<float>(found - objects.begin() + 1);
  all_ = render_gbuffer(*traced_, nullptr, options_);
  const RenderSurfaces surfaces(*traced_, {});
  tangents_ = traced([&](const Vertex& vertex) { return surfaces.to_world(vertex, {1, 0, 0}); }).normal;
  bitangents_ = traced([&](const Vertex& vertex) { return surfaces.to_world(vertex, {0, 1, 0}); }).normal;
  uvs_ = traced([&](const Vertex& vertex) {
           const SceneObject& object = objects[surfaces.object_of(vertex)];
           const Vec2 uv = surfaces.at(vertex, *uv_layer(scene_.survey.mesh_of(object), ""));
           return Vec3(uv.x, uv.y, 0);
         }).normal;
  found->visible_to_camera = false;
  static_ = render_gbuffer(*traced_, nullptr, options_);
  found->visible_to_camera = true;
}

DeferredScene::~DeferredScene() = default;

GBuffer DeferredScene::traced(const SurfaceVector& vector) const {
  return trace_gbuffer(*traced_, camera_of(scene_), options_, vector);
}

const HeightField* DeferredScene::relief(std::size_t object) const {
  const auto found = reliefs_.find(scene_.survey.objects[object].key);
  return found == reliefs_.end() ? nullptr : &found->second;
}

Vec3 DeferredScene::to_view(const Vec3& direction) const {
  return in_camera(camera_of(scene_).to_world.inverse(), direction);
}

FloatImage DeferredScene::to_view(const FloatImage& normals) const {
  const Mat44 to_camera = camera_of(scene_).to_world.inverse();
  FloatImage result = normals;
  for (int y = 0; y < normals.height(); ++y) {
    for (int x = 0; x < normals.width(); ++x) {
      const Vec3 normal = in_camera(to_camera, vec3_at(normals, x, y));
      for (int c = 0; c < 3; ++c) result.texel(x, y)[static_cast<std::size_t>(c)] = normal[c];
    }
  }
  return result;
}

Vec2 DeferredScene::uv_of_length() const {
  const Camera& camera = camera_of(scene_);
  const double width = 2 * std::tan(camera.angle_x / 2);
  const double height = width * options_.height / options_.width / pixel_shape(camera);
  return Vec2(static_cast<float>(1 / width), static_cast<float>(-1 / height));
}

LitPixels DeferredScene::lit(const Vec3& to_sun) const {
  const auto image = [&] { return FloatImage(options_.width, options_.height, 1); };
  LitPixels result{image(), image(), image(), image()};
  std::map<std::tuple<std::size_t, int, int, int>, ReliefShadows> by_face;
  const auto shadows_on = [&](std::size_t object, const HeightField& field,
                              const Vec3& light) -> const ReliefShadows& {
    const auto rounded = [](float value) { return static_cast<int>(std::lround(value * 1e4F)); };
    const std::tuple key{object, rounded(light.x), rounded(light.y), rounded(light.z)};
    const auto found = by_face.find(key);
    return found != by_face.end() ? found->second
                                  : by_face.emplace(key, shadows_of(field, light)).first->second;
  };
  for (int y = 0; y < options_.height; ++y) {
    for (int x = 0; x < options_.width; ++x) {
      if (all_.coverage.texel(x, y)[0] == 0) continue;
      const Vec3 face = vec3_at(all_.face, x, y);
      if (to_sun.dot(face) <= 0) continue;
      result.cosine.texel(x, y)[0] = std::max(0.0F, to_sun.dot(vec3_at(all_.normal, x, y)));
      const Vec3 start = Vec3(Vec3d(vec3_at(all_.position, x, y)) - traced_->origin()) + face * 1e-4F;
      const bool blocked =
          traced_->visibility({start, to_sun, std::numeric_limits<float>::infinity()}).blocked();
      result.seen.texel(x, y)[0] = blocked ? 0 : 1;
      result.truth.texel(x, y)[0] = result.forward.texel(x, y)[0] = 1;
      const auto object = static_cast<std::size_t>(all_.object.texel(x, y)[0]) - 1;
      const HeightField* field = relief(object);
      if (field == nullptr) continue;
      const Vec3 light(to_sun.dot(vec3_at(tangents_, x, y)), to_sun.dot(vec3_at(bitangents_, x, y)),
                       to_sun.dot(face));
      const ReliefShadows& shadows = shadows_on(object, *field, unit(light));
      const Vec3 uv = vec3_at(uvs_, x, y);
      result.truth.texel(x, y)[0] = sampled(shadows.truth, {uv.x, uv.y});
      result.forward.texel(x, y)[0] = sampled(shadows.forward, {uv.x, uv.y});
    }
  }
  return result;
}

}  // namespace rnmbake
