#include "pipeline/render/view_halves.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rnmbake {
namespace {

constexpr int looked_up_samples = 16;

}  // namespace

FloatImage Halves::mean() const {
  FloatImage image = first;
  for (std::size_t i = 0; i < second.data().size(); ++i)
    image.data()[i] = (first.data()[i] + second.data()[i]) / 2;
  return image;
}

int half_of(int samples) {
  return std::max(1, samples / 2);
}

ViewTruth trace_truth(const TraceScene& scene, const SurfaceLights& lights, RenderOptions options) {
  options.view.samples = half_of(options.view.samples);
  View first = render_view(scene, lights, {Lighting::Kind::truth, {}}, options);
  options.view.seed = hash_of(options.view.seed, 1);
  View second = render_view(scene, lights, {Lighting::Kind::truth, {}}, options);
  return {{std::move(first.beauty), std::move(second.beauty)}, std::move(first.coverage)};
}

Halves looked_up(const TraceScene& scene, const SurfaceLights& lights, const Lighting& lighting,
                 RenderOptions options) {
  options.view.samples = std::min(looked_up_samples, options.view.samples);
  return {render_view(scene, lights, lighting, options).beauty, {}};
}

ViewPicture compared(const std::string& label, const Halves& halves, const ViewTruth& truth) {
  PictureComparison comparison;
  comparison.add(halves.compared(), truth.halves.compared(), {{&truth.coverage, 0.5F}});
  const PictureMetrics metrics = comparison.metrics();
  ViewPicture picture{label, halves.mean()};
  picture.has_error = metrics.texels > 0 && metrics.reference_mean > 0;
  picture.rmse = metrics.rmse.value;
  picture.relative_rmse = metrics.relative_rmse.value;
  picture.bias = metrics.bias.value;
  picture.relative_bias = metrics.relative_bias.value;
  return picture;
}

}  // namespace rnmbake
