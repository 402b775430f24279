// pipeline/lightmaps/target_facts.h - what a bake and a reference say of a target alike: its surface, its
// header.
#pragma once

#include "bake/targets.h"
#include "config/bake_settings.h"
#include "lightmap/metadata.h"
#include "scene/surface.h"
#include "scene/survey.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rnmbake {

/// Corners whose UVs say nothing of where the tangent points, over all targets.
class LostDirections {
 public:
  void add(const Target& target, std::size_t corners);
  /// One line for all of them.
  void warn() const;

 private:
  std::size_t corners_ = 0;
  std::vector<std::string> names_;
};

/// World-space triangles, relative to `origin`, with the frames of the target's tangent UVs.
[[nodiscard]] Surface surface_of(const SceneSurvey& survey, const Target& target, LostDirections& lost,
                                 const Vec3d& origin = Vec3d(0));

/// All of the header that the target and its settings decide; recipe, horizon, footprint, bounces and
/// Blender's version are the caller's.
[[nodiscard]] LightmapMetadata target_metadata(const Target& target, const ObjectSettings& object,
                                               const OutputSettings& output);

/// The same for meshes of the same corners, faces and slots in the same order, wherever their vertices lie:
/// those between which UVs can be exchanged. 32 hexadecimal digits.
[[nodiscard]] std::string mesh_hash(const Mesh& mesh);

/// Of a UV for each corner; the same only for the very same numbers.
[[nodiscard]] std::string uv_hash(const std::vector<Vec2>& uv);

}  // namespace rnmbake
