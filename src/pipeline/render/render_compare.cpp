#include "pipeline/render/render_compare.h"

#include "base/log.h"
#include "image/metrics.h"
#include "pipeline/render/render_cycles.h"
#include "report/finding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rnmbake {
namespace {

constexpr int looked_up_samples = 16;

struct Decoded {
  const char* label;
  DecodeVariant variant;
};
constexpr std::array<Decoded, 5> decodes{{{"single lightmap", DecodeVariant::single},
                                          {"RNM, squared", DecodeVariant::squared},
                                          {"RNM, linear", DecodeVariant::linear},
                                          {"RNM, vrad", DecodeVariant::vrad},
                                          {"as encoded", DecodeVariant::encoded}}};

/// A picture, or the two halves of one that has noise.
struct Halves {
  FloatImage first, second;

  [[nodiscard]] FloatImage mean() const {
    FloatImage image = first;
    for (std::size_t i = 0; i < second.data().size(); ++i)
      image.data()[i] = (first.data()[i] + second.data()[i]) / 2;
    return image;
  }
  [[nodiscard]] ComparedPicture compared() const {
    return {&first, second.empty() ? nullptr : &second, nullptr};
  }
};

/// Traced pictures of the view; pixels without a surface have coverage 0.
struct Truth {
  Halves halves;
  FloatImage coverage;
};

int half_of(int samples) {
  return std::max(1, samples / 2);
}

/// Gives the first half the camera rays of the decoded pictures.
Truth trace(const TraceScene& scene, const SceneLightmaps& lightmaps, RenderOptions options) {
  options.view.samples = half_of(options.view.samples);
  View first = render_view(scene, &lightmaps, {Lighting::Kind::truth, {}}, options);
  options.view.seed = hash_of(options.view.seed, 1);
  View second = render_view(scene, &lightmaps, {Lighting::Kind::truth, {}}, options);
  return {{std::move(first.beauty), std::move(second.beauty)}, std::move(first.coverage)};
}

Halves decode(const TraceScene& scene, const SceneLightmaps& lightmaps, DecodeVariant variant,
              RenderOptions options) {
  options.view.samples = std::min(looked_up_samples, options.view.samples);
  return {render_view(scene, &lightmaps, {Lighting::Kind::decoded, variant}, options).beauty, {}};
}

Halves cycles(BlenderSession& session, const ExportResult& exported, const ViewCompareOptions& options) {
  const ViewOptions& view = options.render.view;
  const int seed = session.settings().object.seed;
  std::vector<FloatImage> pictures = render_cycles(session, exported,
                                                   {view.width,
                                                    view.height,
                                                    half_of(view.samples),
                                                    session.settings().bake.bounces,
                                                    {seed, seed + 1},
                                                    options.own_materials});
  return {std::move(pictures[0]), std::move(pictures[1])};
}

ViewPicture compared(const std::string& label, const Halves& halves, const Truth& truth) {
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

}  // namespace

RenderOptions render_options(const Camera& camera, int longest) {
  const int side = std::max(camera.resolution_x, camera.resolution_y);
  const double scale = std::min(1.0, double(longest) / std::max(1, side));
  const auto scaled = [&](int pixels) { return std::max(4, static_cast<int>(std::lround(pixels * scale))); };
  RenderOptions options;
  options.view.width = scaled(camera.resolution_x);
  options.view.height = scaled(camera.resolution_y);
  return options;
}

ViewComparison compare_view(BlenderSession& session, const ExportResult& exported, const TraceScene& scene,
                            const SceneLightmaps& lightmaps, const ViewCompareOptions& options) {
  const Truth truth = trace(scene, lightmaps, options.render);
  ViewComparison view;
  view.name = camera_of(exported.diffuse_scene).name;
  view.pictures.push_back({"truth", truth.halves.mean()});
  if (options.with_cycles && exported.blends) {
    view.pictures.push_back(compared(options.own_materials ? "Cycles, own materials" : "Cycles",
                                     cycles(session, exported, options), truth));
  }
  for (const auto& [label, variant] : decodes) {
    if (const auto why = lightmaps.obstacle(variant)) {
      log::warn("no picture '{}': {}", label, *why);
      continue;
    }
    view.pictures.push_back(compared(label, decode(scene, lightmaps, variant, options.render), truth));
  }
  return view;
}

std::string finding_of(const ViewComparison& view) {
  std::string text;
  for (const ViewPicture& picture : view.pictures) {
    if (!picture.has_error) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", picture.label, percent(picture.relative_rmse));
  }
  return fmt::format("Seen from '{}', RMSE against the truth, of its mean: {}.", view.name, text);
}

}  // namespace rnmbake
