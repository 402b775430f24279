#include "pipeline/ssbump/decode_directions.h"

#include "base/error.h"
#include "encoding/direction_sets.h"
#include "encoding/flip_green.h"
#include "image/sample.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

constexpr float same_direction = 1e-3F;

void check_lightmap(const LightmapMetadata& metadata) {
  if (const auto why = decode_obstacle(metadata, DecodeVariant::single))
    fail(ExitCode::unsupported, "the lightmap does not fit weights of directions: {}; give the bake itself",
         *why);
  if (metadata.normalize == Normalize::flat) {
    fail(ExitCode::unsupported,
         "the lightmap's maps are scaled to the flat bake (normalize flat), which weights of directions do "
         "not expect; bake with --normalize none");
  }
}

/// The lightmap's layer for a direction of the map. By direction alone where y points down, since a set's
/// mirror image has the same vectors under other names.
FloatImage layer_for(Lightmap& lightmap, const BasisDirection& wanted, const BasisSet& set) {
  const LightmapMetadata& metadata = lightmap.metadata;
  const bool is_down = metadata.green == Green::y_down;
  const Vec3 direction = is_down ? flip_green(wanted.direction) : wanted.direction;
  for (const BasisDirection& basis : metadata.bases) {
    const bool is_near = (basis.direction - direction).length() < same_direction;
    if (!is_near || (!is_down && basis.name != wanted.name)) continue;
    FloatImage layer = lightmap.take(basis.name);
    if (!layer.empty()) return layer;
  }
  fail(ExitCode::unsupported,
       "the self-shadowed bump map is of the set {} and the lightmap of {}, which has no '{}'; bake with "
       "the map's set, or make the map with the lightmap's",
       set.name, name_of_set(metadata.bases), wanted.name);
}

}  // namespace

FloatImage decode_directions(Lightmap lightmap, const DirectionMap& map) {
  check_lightmap(lightmap.metadata);
  std::vector<FloatImage> layers;
  for (const BasisDirection& basis : map.metadata.set.directions)
    layers.push_back(layer_for(lightmap, basis, map.metadata.set));
  FloatImage result(map.weights.width(), map.weights.height(), 3);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      auto taps = bilinear_taps(layers.front(), texel_uv(result, x, y), Border::clamp);
      if (!lightmap.coverage.empty()) taps = covered_taps(taps, lightmap.coverage);
      Vec3 sum(0);
      for (std::size_t i = 0; i < layers.size(); ++i)
        sum += sampled_vec3(layers[i], taps) * map.weights.texel(x, y)[i];
      set_vec3(result, x, y, {std::max(0.0F, sum.x), std::max(0.0F, sum.y), std::max(0.0F, sum.z)});
    }
  }
  return result;
}

}  // namespace rnmbake
