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
constexpr std::array<Decoded, 4> decodes{{{"single lightmap", DecodeVariant::single},
                                          {"RNM, squared", DecodeVariant::squared},
                                          {"RNM, linear", DecodeVariant::linear},
                                          {"RNM, vrad", DecodeVariant::vrad}}};

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

class ViewRun {
 public:
  ViewRun(BlenderSession& session, const ExportResult& exported, const TraceScene& scene,
          const SceneLightmaps& lightmaps, const ViewCompareOptions& options)
      : session_(session),
        exported_(exported),
        scene_(scene),
        lightmaps_(lightmaps),
        options_(options),
        half_(std::max(1, options.render.view.samples / 2)) {}

  ViewComparison run() {
    truth_ = truth();
    ViewComparison view;
    view.name = camera_of(exported_.diffuse_scene).name;
    view.pictures.push_back({"truth", truth_.mean()});
    if (options_.with_cycles && exported_.blends)
      view.pictures.push_back(judged(options_.own_materials ? "Cycles, own materials" : "Cycles", cycles()));
    for (const Decoded& decode : decodes) {
      if (const auto why = lightmaps_.obstacle(decode.variant)) {
        log::warn("no picture '{}': {}", decode.label, *why);
        continue;
      }
      view.pictures.push_back(judged(decode.label, decoded(decode.variant)));
    }
    return view;
  }

 private:
  /// The first half has the camera rays of the decoded pictures.
  [[nodiscard]] Halves truth() {
    RenderOptions options = options_.render;
    options.view.samples = half_;
    View first = render_view(scene_, &lightmaps_, {Lighting::Kind::truth, {}}, options);
    options.view.seed = hash_of(options.view.seed, 1);
    View second = render_view(scene_, &lightmaps_, {Lighting::Kind::truth, {}}, options);
    coverage_ = std::move(first.coverage);
    return {std::move(first.beauty), std::move(second.beauty)};
  }

  [[nodiscard]] Halves decoded(DecodeVariant variant) const {
    RenderOptions options = options_.render;
    options.view.samples = std::min(looked_up_samples, options.view.samples);
    return {render_view(scene_, &lightmaps_, {Lighting::Kind::decoded, variant}, options).beauty, {}};
  }

  [[nodiscard]] Halves cycles() const {
    const ViewOptions& view = options_.render.view;
    const int seed = session_.settings().object.seed;
    std::vector<FloatImage> pictures = render_cycles(session_, exported_,
                                                     {view.width,
                                                      view.height,
                                                      half_,
                                                      session_.settings().bake.bounces,
                                                      {seed, seed + 1},
                                                      options_.own_materials});
    return {std::move(pictures[0]), std::move(pictures[1])};
  }

  [[nodiscard]] ViewPicture judged(const std::string& label, const Halves& halves) const {
    PictureComparison comparison;
    comparison.add(halves.compared(), truth_.compared(), {{&coverage_, 0.5F}});
    const PictureMetrics metrics = comparison.metrics();
    ViewPicture picture{label, halves.mean()};
    picture.has_error = metrics.texels > 0 && metrics.reference_mean > 0;
    picture.rmse = metrics.rmse.value;
    picture.relative_rmse = metrics.relative_rmse.value;
    picture.bias = metrics.bias.value;
    picture.relative_bias = metrics.relative_bias.value;
    return picture;
  }

  BlenderSession& session_;
  const ExportResult& exported_;
  const TraceScene& scene_;
  const SceneLightmaps& lightmaps_;
  const ViewCompareOptions& options_;
  int half_;
  Halves truth_;
  FloatImage coverage_;
};

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
  return ViewRun(session, exported, scene, lightmaps, options).run();
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
