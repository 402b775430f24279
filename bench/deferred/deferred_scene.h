// bench/deferred/deferred_scene.h - a scene as a deferred renderer sees it, with the exact shadows of its
// reliefs.
#pragma once

#include "ssbump/heights/height_field.h"
#include "ssbump/normal_shadows/normal_shadows.h"
#include "trace/gbuffer.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace rnmbake {

/// Heights, in texels, behind the normal maps of objects, by name. Others have no relief.
using Reliefs = std::map<std::string, HeightField>;

/// Of a JSON file: for each object a list of rows, the top one first.
[[nodiscard]] Reliefs read_reliefs(const std::filesystem::path& file);

/// One channel for each quantity of a pixel under one light.
struct LitPixels {
  FloatImage cosine;   // between light and mapped normal, 0 where the face or the normal looks away from it
  FloatImage seen;     // 1 where no other surface is in the light's way
  FloatImage truth;    // share of the light that the relief's exact shadow leaves
  FloatImage forward;  // the same by normal mapping shadows in texture space, as published
};

class DeferredScene {
 public:
  /// `file`: a .rnmscene. `characters`: the object that is drawn after the static world.
  DeferredScene(const std::filesystem::path& file, Reliefs reliefs, const std::string& character, int width,
                int height);
  ~DeferredScene();

  [[nodiscard]] const GBuffer& all() const { return all_; }
  [[nodiscard]] const GBuffer& static_world() const { return static_; }
  [[nodiscard]] float character() const { return character_; }  // its number in the G-buffer

  /// Unit normals, or a direction, in the camera's space.
  [[nodiscard]] FloatImage to_view(const FloatImage& normals) const;
  [[nodiscard]] Vec3 to_view(const Vec3& direction) const;

  /// UVs, v running down, that a length of 1 across the view covers at depth 1.
  [[nodiscard]] Vec2 uv_of_length() const;

  [[nodiscard]] LitPixels lit(const Vec3& to_sun) const;

 private:
  [[nodiscard]] GBuffer traced(const SurfaceVector& vector) const;
  [[nodiscard]] const HeightField* relief(std::size_t object) const;

  DiffuseScene scene_;
  Reliefs reliefs_;
  ViewOptions options_;
  std::unique_ptr<TraceScene> traced_;
  float character_ = 0;
  GBuffer all_, static_;
  FloatImage tangents_, bitangents_, uvs_;  // of what is seen
};

}  // namespace rnmbake
