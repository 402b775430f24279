// scene/diffuse_scene.h - a whole scene as a diffuse path tracer needs it: geometry, materials, lights,
// world, camera. Kept in one .rnmscene file (docs/rnmscene-format.md).
#pragma once

#include "base/math.h"
#include "scene/survey.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// Linear colours, row 0 on top: texel (x, y) has the UV (x + 0.5) / width, 1 - (y + 0.5) / height.
struct Texture {
  int width = 0, height = 0;
  std::vector<Vec3> texels;  // finite; of emission and the world they may be negative
  std::string name = {};     // Blender's, for messages
};

/// A normal map of a material: what is read through `uv_layer` and decoded as 2c - 1, Y up.
struct NormalMap {
  int picture = -1;
  std::string uv_layer;  // "": the active-render layer
  float strength = 1;
};

/// What one material slot of one object is to Cycles: an ideal diffuse reflector that may glow and
/// let light straight through. A picture stands in place of the constant; it is read bilinearly, clamped at
/// the borders.
struct SurfaceMaterial {
  std::string name;
  Vec3 albedo{0, 0, 0};                            // in [0, 1]
  Vec3 emission{0, 0, 0};                          // radiance, the same from both sides; may be negative
  int albedo_picture = -1, emission_picture = -1;  // indices into DiffuseScene::pictures
  int picture_uv = -1;                             // index into DiffuseScene::picture_uvs
  int normal_map = -1;                             // index into DiffuseScene::normal_maps
  Vec3 transmittance{0, 0, 0};  // in [0, 1], with the albedo at most 1; the same from both sides
  int transmittance_picture = -1;

  /// Whether light goes through some of it.
  [[nodiscard]] bool see_through() const {
    return transmittance_picture >= 0 || transmittance != Vec3(0, 0, 0);
  }
};

/// Radiance from where nothing is hit; may be negative. A picture is equirectangular as Blender's: the top
/// row is +z, the middle column +x, the left quarter +y (see world_uv()).
struct World {
  Vec3 radiance{0, 0, 0};
  int picture = -1;
};

struct Camera {
  std::string name;
  Mat44 to_world;  // looks along -z, y is up
  bool orthographic = false;
  double angle_x = 0.8, angle_y = 0.6;  // full field of view, radians
  double width = 0;                     // of an orthographic view, units
  double shift_x = 0, shift_y = 0;      // in widths of the picture
  int resolution_x = 960, resolution_y = 540;
};

/// Something that Cycles renders and a tracer of this scene cannot.
struct OutsideModel {
  std::string owner;              // "object 'Vase'", "light 'Lamp'", "world"
  std::vector<std::string> what;  // "glossy", "volume", ...
  /// Of these, what is left in the lambert scene, so that Cycles' bakes of that differ from what is traced.
  std::vector<std::string> untraced = {};
};

struct DiffuseScene {
  SceneSurvey survey;
  std::vector<Texture> pictures;
  std::vector<std::vector<Vec2>> picture_uvs;  // each with one UV for each loop of the mesh that uses it
  std::vector<NormalMap> normal_maps;
  std::vector<SurfaceMaterial> materials;
  std::vector<std::vector<int>> object_materials;  // [objects][slots], never empty for an object
  std::vector<char>
      unlit;  // [objects] or empty, 1: shows itself to cameras alone, blocks and reflects nothing
  World world;
  std::optional<Camera> camera;
  std::vector<OutsideModel> outside;

  [[nodiscard]] const SurfaceMaterial& material(std::size_t object,
                                                std::size_t slot) const;  // slots past the last: the last
  [[nodiscard]] bool takes_part(std::size_t object) const {
    return object >= unlit.size() || unlit[object] == 0;
  }
};

/// Where Blender reads an equirectangular picture for a unit direction; v runs up.
[[nodiscard]] Vec2 world_uv(const Vec3& direction);
/// The inverse of world_uv(): unit direction.
[[nodiscard]] Vec3 world_direction(const Vec2& uv);

inline constexpr const char* diffuse_scene_ending = ".rnmscene";

/// Checks the checksum, then sizes, indices and finiteness of everything. Throws Error(io) where the file
/// cannot be read, Error(unsupported) for another version, Error(invalid_input) naming file, owner and what
/// is wrong.
[[nodiscard]] DiffuseScene read_diffuse_scene(const std::filesystem::path& file);

/// The same from memory, whatever the checksum says: what a fuzzer feeds. `name` goes into messages.
[[nodiscard]] DiffuseScene parse_diffuse_scene(const std::vector<char>& bytes, const std::string& name);

/// What export_entry.py left: survey.json with the key "exchange", and its data (docs/rnmscene-format.md).
[[nodiscard]] DiffuseScene read_exported(const std::filesystem::path& json_file);

/// The bytes of the file; the same for the same scene.
[[nodiscard]] std::string diffuse_scene_bytes(const DiffuseScene& scene);

/// Hash of all that light depends on, as 32 hexadecimal digits: not of paths, messages or the camera.
[[nodiscard]] std::string light_hash(const DiffuseScene& scene);

/// Writes whole or not at all. Throws Error(io).
void write_diffuse_scene(const std::filesystem::path& file, const DiffuseScene& scene);

}  // namespace rnmbake
