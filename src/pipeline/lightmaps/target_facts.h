// pipeline/lightmaps/target_facts.h - surface and header of a target, for bake and reference alike.
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

/// Number of corners whose UVs are degenerate, so that their tangent is arbitrary, over all targets.
class LostDirections {
 public:
  void add(const Target& target, std::size_t corners);
  /// Warns in one line.
  void warn() const;

 private:
  std::size_t corners_ = 0;
  std::vector<std::string> names_;
};

/// World-space triangles, relative to `origin`, with the frames of the target's tangent UVs.
[[nodiscard]] Surface surface_of(const SceneSurvey& survey, const Target& target, LostDirections& lost,
                                 const Vec3d& origin = Vec3d(0));

/// Header entries that follow from target and settings; the caller adds recipe, horizon, footprint, bounces
/// and Blender's version.
[[nodiscard]] LightmapMetadata target_metadata(const Target& target, const ObjectSettings& object,
                                               const OutputSettings& output);

/// Hash of corners, faces and slots in their order, not of vertex positions: meshes with the same hash can
/// exchange UVs. 32 hexadecimal digits.
[[nodiscard]] std::string mesh_hash(const Mesh& mesh);

/// Hash of the UVs of all corners, bit by bit.
[[nodiscard]] std::string uv_hash(const std::vector<Vec2>& uv);

}  // namespace rnmbake
