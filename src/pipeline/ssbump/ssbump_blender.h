// pipeline/ssbump/ssbump_blender.h - the weights of a height map, baked by Cycles.
#pragma once

#include "blender/blender_session.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/map/weights.h"

namespace rnmbake {

struct SsbumpBlenderOptions {
  /// sky: a white sky over receivers that face along each axis, so that a bake is the visible integral of
  /// max(0, D . axis); the definition of ssbump/map/weights.h with power 1. area: the published way, a red, a
  /// green and a blue area light along the basis vectors over a flat receiver; a weight is the share of its
  /// light's irradiance that arrives. Channels 3 and 4 are the sky's in both.
  enum class Lights { sky, area };
  Lights lights = Lights::sky;
  int samples = 250;
  int seed = 0;
};

/// Half the angle that an area light is seen under; it stands 50 map sizes away.
inline constexpr double area_light_half_angle = 30;  // degrees

/// The surface is height_mesh() with its copies, black. Throws Error(unsupported) above 1024 x 1024 texels,
/// and as BlenderSession::run().
[[nodiscard]] SsbumpWeights bake_height_map(BlenderSession& session, const HeightField& field,
                                            const SsbumpBlenderOptions& options);

}  // namespace rnmbake
