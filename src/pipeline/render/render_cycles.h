// pipeline/render/render_cycles.h - the camera's view as Cycles renders it.
#pragma once

#include "blender/blender_session.h"
#include "image/float_image.h"
#include "pipeline/scene/export_scene.h"

#include <vector>

namespace rnmbake {

struct CyclesOptions {
  int width = 960, height = 540;
  int samples = 256;
  int bounces = 32;
  std::vector<int> seeds{0};
  bool own_materials = false;  // else the lambert ones, with their normal maps
};

/// Linear RGB for each seed, in one launch: unfiltered, not denoised, the world behind; no depth of field, no
/// motion blur. Throws Error(usage) where the scene is a .rnmscene, and as BlenderSession::run().
[[nodiscard]] std::vector<FloatImage> render_cycles(BlenderSession& session, const ExportResult& exported,
                                                    const CyclesOptions& options);

}  // namespace rnmbake
