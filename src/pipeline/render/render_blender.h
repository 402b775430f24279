// pipeline/render/render_blender.h - the camera's view as Cycles or Eevee renders it.
#pragma once

#include "blender/blender_session.h"
#include "image/float_image.h"
#include "pipeline/scene/export_scene.h"
#include "trace/view.h"

#include <vector>

namespace rnmbake {

enum class BlenderEngine { cycles, eevee };

struct BlenderViewOptions {
  BlenderEngine engine = BlenderEngine::cycles;
  int width = 960, height = 540;
  int samples = 256;
  int bounces = 32;            // of Cycles; Eevee's lamps light what they reach directly
  std::vector<int> seeds{0};   // Eevee has none, so one
  bool own_materials = false;  // else the lambert ones, with their normal maps
};

/// Cycles with the size and samples of `view`, and the session's bounces and seed.
[[nodiscard]] BlenderViewOptions blender_view(const BlenderSession& session, const ViewOptions& view,
                                              bool own_materials);

/// Linear RGB for each seed, in one launch: unfiltered, not denoised, the world behind; no depth of field, no
/// motion blur. Eevee needs OpenGL, if by software. Throws Error(usage) where the scene is a .rnmscene, and
/// as BlenderSession::run().
[[nodiscard]] std::vector<FloatImage> render_blender(BlenderSession& session, const ExportResult& exported,
                                                     const BlenderViewOptions& options);

}  // namespace rnmbake
