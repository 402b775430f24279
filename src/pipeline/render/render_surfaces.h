// pipeline/render/render_surfaces.h - the scene as a shader sees it: UVs, tangent frames and normal maps at a
// place.
#pragma once

#include "base/math.h"
#include "image/float_image.h"
#include "scene/diffuse_scene.h"
#include "scene/tangents.h"
#include "trace/scene.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

class RenderSurfaces {
 public:
  /// `tangent_layers`: of objects (index into SceneSurvey::objects) whose frames follow another UV layer than
  /// their normal map's. Throws Error(invalid_input) where an object lacks the layer.
  RenderSurfaces(const TraceScene& scene, const std::map<std::size_t, std::string>& tangent_layers);

  /// Normal of the material's normal map there: unit, tangent space, right-handed, Y up; +z without one.
  [[nodiscard]] Vec3 mapped_normal(const Vertex& vertex) const;

  /// A tangent-space normal in world space, unit, on the side that the vertex is seen from.
  [[nodiscard]] Vec3 to_world(const Vertex& vertex, const Vec3& normal) const;

  /// Interpolates a value of the mesh's loops at the vertex's barycentric weights.
  [[nodiscard]] Vec2 at(const Vertex& vertex, const std::vector<Vec2>& of_loops) const;

  [[nodiscard]] std::size_t object_of(const Vertex& vertex) const {
    return scene_.triangles().object[vertex.triangle];
  }
  [[nodiscard]] std::uint32_t source_of(const Vertex& vertex) const {
    return scene_.triangles().source[vertex.triangle];
  }

 private:
  struct OnObject {
    std::optional<TangentFrames> frames;  // where a normal map or a lightmap needs them
    bool mirrored = false;                // the tracer's corners 1 and 2 are the mesh's 2 and 1
  };

  /// Corner of the mesh, counted over all its triangles.
  [[nodiscard]] std::size_t corner(const Vertex& vertex, std::size_t k) const;

  const TraceScene& scene_;
  std::vector<OnObject> objects_;
  std::vector<FloatImage> normal_pictures_;  // [DiffuseScene::normal_maps]
};

/// The UV layer of that name, "" for the active-render layer or the first; null where there is none.
[[nodiscard]] const std::vector<Vec2>* uv_layer(const Mesh& mesh, const std::string& name);

}  // namespace rnmbake
