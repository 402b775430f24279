// pipeline/render/render_compare.h - one view of a scene in several ways, held against the traced truth.
#pragma once

#include "blender/blender_session.h"
#include "pipeline/render/render_lightmaps.h"
#include "pipeline/render/render_view.h"
#include "pipeline/scene/export_scene.h"
#include "report/comparison.h"
#include "trace/scene.h"

#include <filesystem>
#include <vector>

namespace rnmbake {

struct ViewCompareOptions {
  RenderOptions render;  // its samples: for each pixel of what is traced; looked-up pictures take 16 at most
  bool with_cycles = true;
  bool with_eevee = false;
  bool own_materials = false;                  // of Cycles' and Eevee's pictures
  std::vector<std::filesystem::path> encoded;  // converted lightmaps, a picture each
};

/// Size, seed, threads and bounces for a view of `scene`: its camera's picture, scaled down to `longest`
/// pixels.
[[nodiscard]] RenderOptions render_options(const Camera& camera, int longest = 960);

/// Truth, Cycles and Eevee (not for a scene without a .blend), single lightmap, RNM squared, linear and vrad,
/// as far as the lightmaps allow, and each of the converted ones; logs the reason
/// for each missing one. Truth and Cycles are rendered in two independent halves, so that errors are free of
/// their noise; they are over the pixels that show surfaces. Throws as render_view() and render_blender(),
/// but for Eevee's picture, and Error(usage) where `encoded` names lightmaps that were not converted.
[[nodiscard]] ViewComparison compare_view(BlenderSession& session, const ExportResult& exported,
                                          const TraceScene& scene, const SceneLightmaps& lightmaps,
                                          const ViewCompareOptions& options);

/// Sentence of a report about a view: "Cycles 1.2 %, single lightmap 24 %, ..." (RMSE, relative to the
/// truth's mean).
[[nodiscard]] std::string finding_of(const ViewComparison& view);

}  // namespace rnmbake
