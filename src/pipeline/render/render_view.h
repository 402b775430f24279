// pipeline/render/render_view.h - the camera's view of a scene, lit by its lightmaps or traced.
#pragma once

#include "lightmap/decode.h"
#include "pipeline/render/render_lightmaps.h"
#include "pipeline/render/render_probes.h"
#include "trace/view.h"

#include <memory>
#include <optional>
#include <string>

namespace rnmbake {

/// Lighting of the surfaces.
struct Lighting {
  enum class Kind {
    decoded,  // albedo x decoded lightmap; surfaces without one are traced
    truth,    // path traced, with each normal map's normal
    none,     // the albedo alone, as under white light from everywhere
    probes,   // albedo x light of the volume where it lights the object; else as decoded, or traced
  };
  Kind kind = Kind::truth;
  DecodeVariant variant = DecodeVariant::squared;  // of decoded
  ProbeLookup lookup = {};                         // of probes
};

/// What surfaces are lit by beside rays. Either may be null where nothing is decoded from it.
struct SurfaceLights {
  const SceneLightmaps* lightmaps = nullptr;
  const SceneProbes* probes = nullptr;
};

/// "single", "squared", "linear", "vrad", "truth", "none", "probes"; nothing for other words.
[[nodiscard]] std::optional<Lighting> lighting_of(const std::string& name);
[[nodiscard]] std::string name_of(const Lighting& lighting);

struct RenderOptions {
  ViewOptions view;
  int bounces = -1;  // surfaces that light may bounce off before it reaches the one seen; -1: no limit
};

/// Throws Error(invalid_input) where the scene has none.
[[nodiscard]] const Camera& camera_of(const DiffuseScene& scene);

/// Throws as SceneLightmaps::decoders() and VolumeSampler, and Interrupted.
[[nodiscard]] View render_view(const TraceScene& scene, const SurfaceLights& lights, const Lighting& lighting,
                               const RenderOptions& options);

}  // namespace rnmbake
