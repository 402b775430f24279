// trace/view.h - renders a camera's view: primary rays, and a caller's radiance at the surfaces they hit.
#pragma once

#include "base/math.h"
#include "image/float_image.h"
#include "sampling/sampler.h"
#include "scene/diffuse_scene.h"
#include "trace/scene.h"

#include <cstdint>
#include <functional>

namespace rnmbake {

/// Keeps the camera's horizontal field of view and the shape of its pixels, whatever the picture's size.
class CameraRays {
 public:
  /// Rays are relative to `origin`.
  CameraRays(const Camera& camera, int width, int height, const Vec3d& origin = Vec3d(0));

  /// In pixels from the top left corner: (0.5, 0.5) is the first pixel's centre.
  [[nodiscard]] Ray through(double x, double y) const;

 private:
  Mat44 to_world_;
  Vec3d origin_;
  bool orthographic_;
  double pixels_x_, pixels_y_;  // of the picture
  double width_, height_;       // of the picture in the camera's space; of a perspective one at distance 1
  double shift_x_, shift_y_;    // in the same units
};

/// Width of a pixel over its height.
[[nodiscard]] double pixel_shape(const Camera& camera);

struct ViewOptions {
  int width = 960, height = 540;
  int samples = 16;  // primary rays of each pixel, at most 65536
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores
};

/// Radiance reflected at a vertex towards the camera, its emission left out.
using ReflectedLight = std::function<Vec3(const Vertex& vertex, Sampler& sampler)>;

/// Averages over each pixel's square (box filter).
struct View {
  FloatImage beauty;    // RGB, radiance: emitted, reflected, or the world's where no surface is hit
  FloatImage albedo;    // RGB, 0 where no surface is hit
  FloatImage coverage;  // one channel: share of the primary rays that hit a surface
};

/// `reflected` is called from several threads. Rays pass objects that are not visible to cameras.
/// Deterministic for a seed at any number of threads; two calls with one seed trace the same primary rays.
/// `progress` receives the share done, one call at a time; `stop` is polled, and once it is true the view is
/// left unfinished.
[[nodiscard]] View trace_view(const TraceScene& scene, const Camera& camera, const ViewOptions& options,
                              const ReflectedLight& reflected,
                              const std::function<void(double)>& progress = {},
                              const std::function<bool()>& stop = {});

}  // namespace rnmbake
