// pipeline/probes/place_volumes.h - which light probes a user asked for, in a scene.
#pragma once

#include "probes/place_probes.h"
#include "scene/diffuse_scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct PlaceWishes {
  std::optional<double> spacing;      // of a box, units
  double probes = 1000;               // of a box without a spacing, about
  std::optional<ProbeBounds> bounds;  // of a box; none: around the scene
  std::vector<std::string> at;        // patterns for names of empties and of Blender's light probe volumes
  std::filesystem::path points;       // a list; "": none
  int levels = 0;                     // how often a box's cells may be halved (grid_in())
};

/// Throws Error(usage) where wishes exclude each other or a pattern fits nothing, and as grid_in() and
/// read_points(). Without a wish: Blender's volumes where the scene has any, else a box around it. `dynamic`:
/// [objects], 1 for those that are no part of it.
[[nodiscard]] std::vector<ProbeVolume> place_volumes(const SceneSurvey& survey, const PlaceWishes& wishes,
                                                     const std::vector<char>& dynamic);

/// Objects whose name or key one of the patterns fits: [objects]. Throws Error(usage) naming a pattern that
/// fits none.
[[nodiscard]] std::vector<char> dynamic_objects(const SceneSurvey& survey,
                                                const std::vector<std::string>& patterns);

}  // namespace rnmbake
