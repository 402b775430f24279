// pipeline/target_facts.h - what a bake and a reference say of a target alike: its surface, its header.
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

/// World-space triangles with the frames of the target's tangent UVs.
[[nodiscard]] Surface surface_of(const Survey& survey, const Target& target, LostDirections& lost);

/// All of the header that the target and its settings decide; recipe, horizon, footprint, bounces and
/// Blender's version are the caller's.
[[nodiscard]] LightmapMetadata target_metadata(const Target& target, const ObjectSettings& object,
                                               const OutputSettings& output);

}  // namespace rnmbake
