// pipeline/render/render_lightmaps.h - lightmaps from disk, put back onto the surfaces that they were made
// for.
#pragma once

#include "lightmap/decode.h"
#include "scene/diffuse_scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// The lightmap of an object or of a part of one.
struct PlacedLightmap {
  std::string key;
  std::size_t object = 0;                 // index into SceneSurvey::objects
  const std::vector<Vec2>* uv = nullptr;  // [loops]
  Lightmap lightmap;
};

class SceneLightmaps {
 public:
  /// `path`: a folder that `bake` or `reference` wrote, or one lightmap. Objects are matched by their keys,
  /// UVs are those of the layer that a lightmap names. Throws as open_lightmaps() and load_lightmap(), and
  /// Error(invalid_input) where no object is on both sides, an object lacks the layer, or most of its faces
  /// lie where the lightmap covers nothing.
  SceneLightmaps(const std::filesystem::path& path, const DiffuseScene& scene);

  [[nodiscard]] const std::vector<PlacedLightmap>& placed() const { return placed_; }

  /// Index into placed(), -1: none. `triangle`: number of the mesh's triangle.
  [[nodiscard]] int find(std::size_t object, std::uint32_t triangle) const;

  /// UV layer of the tangent frames, by object.
  [[nodiscard]] const std::map<std::size_t, std::string>& tangent_layers() const { return tangent_layers_; }

  /// Reason why these lightmaps do not allow that decode; nothing where they do.
  [[nodiscard]] std::optional<std::string> obstacle(DecodeVariant variant) const;

  /// Decoders in the order of placed(). Throws Error(unsupported) where there is an obstacle.
  [[nodiscard]] std::vector<LightmapDecoder> decoders(DecodeVariant variant) const;

  /// Objects that the tracer shows and that have no lightmap.
  [[nodiscard]] const std::vector<std::string>& bare() const { return bare_; }

 private:
  std::vector<PlacedLightmap> placed_;
  std::map<std::size_t, std::vector<int>> by_triangle_;  // object -> [triangles] -> placed_
  std::map<std::size_t, std::string> tangent_layers_;
  std::vector<std::string> bare_;
};

/// Scene file with the unwrapped UVs of the bake in `folder`, which no other file holds; nothing where no UVs
/// were unwrapped, or not saved.
[[nodiscard]] std::optional<std::filesystem::path> scene_with_lightmap_uvs(
    const std::filesystem::path& folder);

}  // namespace rnmbake
