// trace/gather_options.h - what to gather, and what comes of it.
#pragma once

#include "encoding/basis_set.h"
#include "image/float_image.h"
#include "scene/surface.h"
#include "trace/lights/light_sample.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// The square around a texel's centre that it averages over (clipped to the triangle that owns the texel).
enum class Footprint { centre, half, full };  // half: Blender < 5, full: Blender >= 5

/// How a sample of the footprint that lies past the triangle's edge is moved inside. mirror: folded back, one
/// barycentric coordinate after the other (Blender < 4); retry: replaced by up to ten others, then by the
/// centre (Blender >= 4).
enum class PastEdge { mirror, retry };

/// The errors of the published recipe, each of which the tracer can make too (docs/reference.md).
struct RecipeFaults {
  bool tilt_clamp = false;       // Blender 3.4, 3.5: the closure's normal is bent towards the surface's
  bool bump_shadowing = false;   // a factor below 1 on closures whose normal is not the surface's
  bool self_reflection = false;  // the object's own surface has the basis normal for its bounces too
  bool below_horizon = false;    // lamps below the surface but above the basis direction's horizon count
  bool no_diffuse = false;  // surfaces without albedo, such as lamps, bake black; colour channels without
                            // albedo get the mean of the others
  [[nodiscard]] bool any() const {
    return tilt_clamp || bump_shadowing || self_reflection || below_horizon || no_diffuse;
  }
};

struct GatherTarget {
  const Surface* surface = nullptr;
  std::size_t object = 0;  // index into SceneSurvey::objects
  int width = 0, height = 0;
  std::uint64_t stream = 0;  // of random numbers; what a target gathers does not depend on the others
};

struct GatherOptions {
  std::vector<BasisDirection> directions;  // right-handed, Y up, in each texel's own frame
  int sh_order = 0;  // 1, 2 or 3: also 1, 4 or 9 SH coefficients of the incoming radiance
  Footprint footprint = Footprint::half;
  PastEdge past_edge = PastEdge::retry;
  int samples = 256;  // paths for each texel; with `error` the most
  double error = 0;   // > 0: stop where the relative standard error of the target's texels (RMS over them,
                      // over their mean) is that small
  int bounces = -1;   // of a path, the texel's own surface not counted; -1: no limit
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores
  bool sample_lights = true,
       sample_bsdf = true;  // strategies that MIS combines; off only in tests of the other
  DirectLight direct;
  bool reuse = true;  // texels share the vertices of their paths (trace/block.h)
  RecipeFaults faults;
  std::string blender_version;  // whose faults
};

/// One direction of one target. Uncovered texels are 0.
struct GatheredDirection {
  FloatImage radiance;                         // RGB, E/pi
  FloatImage standard_error;                   // RGB, of each texel
  std::array<double, 3> mean{}, mean_error{};  // over the covered texels; standard error of it
};

struct Gathered {
  std::vector<GatheredDirection> directions;
  std::vector<FloatImage> sh;  // RGB each, order l, m = 0: (0,0), (1,-1), (1,0), (1,1), ...; tangent space
  FloatImage coverage;         // one channel, 0 or 1
  FloatImage validity;         // one channel: share of the primary rays that did not meet a back face
  std::int64_t paths = 0;      // traced for this target
  std::int64_t rays = 0;
};

struct GatherProgress {
  double share = 0;        // of all work; with `error` an estimate
  std::size_t target = 0;  // at work now
};

}  // namespace rnmbake
