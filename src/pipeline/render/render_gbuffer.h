// pipeline/render/render_gbuffer.h - the camera's view as the G-buffer of a deferred renderer.
#pragma once

#include "image/layered_exr.h"
#include "pipeline/render/render_lightmaps.h"
#include "trace/gbuffer.h"

namespace rnmbake {

/// Its normals are those of the materials' normal maps, on the side that is seen. `lightmaps` may be null;
/// their tangents count as in render_view(). Throws as camera_of(), RenderSurfaces, and Interrupted.
[[nodiscard]] GBuffer render_gbuffer(const TraceScene& scene, const SceneLightmaps* lightmaps,
                                     const ViewOptions& options);

/// The layers of docs/render.md, with the objects' names and the way from the world into the camera's space
/// in the header.
[[nodiscard]] LayeredImage gbuffer_layers(GBuffer&& gbuffer, const DiffuseScene& scene);

}  // namespace rnmbake
