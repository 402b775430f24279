// pipeline/render/view_halves.h - pictures of a view in independent halves, so that errors are free of noise.
#pragma once

#include "image/float_image.h"
#include "image/metrics.h"
#include "pipeline/render/render_view.h"
#include "report/comparison.h"

#include <string>

namespace rnmbake {

/// A picture, or the two halves of one that has noise.
struct Halves {
  FloatImage first, second;

  [[nodiscard]] FloatImage mean() const;
  [[nodiscard]] ComparedPicture compared() const {
    return {&first, second.empty() ? nullptr : &second, nullptr};
  }
};

/// Traced pictures of the view; pixels without a surface have coverage 0.
struct ViewTruth {
  Halves halves;
  FloatImage coverage;
};

/// Half of the samples, at least one.
[[nodiscard]] int half_of(int samples);

/// Gives the first half the camera rays of looked_up(). Throws as render_view().
[[nodiscard]] ViewTruth trace_truth(const TraceScene& scene, const SurfaceLights& lights,
                                    RenderOptions options);

/// A picture by look-ups, which needs few samples. Throws as render_view().
[[nodiscard]] Halves looked_up(const TraceScene& scene, const SurfaceLights& lights, const Lighting& lighting,
                               RenderOptions options);

/// The picture with its errors, over the pixels that show surfaces.
[[nodiscard]] ViewPicture compared(const std::string& label, const Halves& halves, const ViewTruth& truth);

}  // namespace rnmbake
