// closed_forms/horizon.h - smooth low-poly solids: a right answer for each texel, below the horizon too.
#pragma once

#include "closed_forms/cases.h"
#include "closed_forms/workbench.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace rnmbake {

/// A solid of scenes/smooth.py. `truth`: E/pi of a world-space basis normal b on a face with normal n.
struct HorizonCase {
  std::string name, title;
  SceneChoice scene;
  std::string object;
  bool sun = false;  // else a sky: its bakes are noisy
  std::function<double(const Vec3d& b, const Vec3d& n)> truth;
};
[[nodiscard]] std::vector<HorizonCase> horizon_cases();
[[nodiscard]] Words horizon_flags();

/// Errors over some texels and all bases. `truth` is their mean right answer.
struct ErrorSummary {
  std::size_t texels = 0;
  double truth = 0, mean = 0, standard_error = 0, rms = 0, largest = 0;
};

struct HorizonOutcome {
  ErrorSummary above, below;  // texels whose basis normal lies above or below its face
};

/// The right answer is averaged over the texel as Blender's samples are spread (`footprint`, in texels).
[[nodiscard]] HorizonOutcome compare_horizon(const HorizonCase& horizon, const SceneSurvey& survey,
                                             const LayeredImage& lightmap, double footprint);

/// Texels along a side that a version's samples are spread over.
[[nodiscard]] double footprint_of(const BlenderVersion& version);

}  // namespace rnmbake
