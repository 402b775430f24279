#include "pipeline/render/render_compare.h"

#include "base/error.h"
#include "base/log.h"
#include "encoding/codecs/describe_codec.h"
#include "encoding/codecs/make_codec.h"
#include "pipeline/render/render_blender.h"
#include "pipeline/render/view_halves.h"
#include "report/finding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace rnmbake {
namespace {

constexpr int eevee_samples = 64;

struct Decoded {
  const char* label;
  DecodeVariant variant;
  int bytes;  // of a texel, as half floats
};
constexpr std::array<Decoded, 4> decodes{{{"single lightmap", DecodeVariant::single, 6},
                                          {"RNM, squared", DecodeVariant::squared, 18},
                                          {"RNM, linear", DecodeVariant::linear, 18},
                                          {"RNM, vrad", DecodeVariant::vrad, 18}}};

Halves cycles(BlenderSession& session, const ExportResult& exported, const ViewCompareOptions& options) {
  BlenderViewOptions halves = blender_view(session, options.render.view, options.own_materials);
  halves.samples = half_of(halves.samples);
  halves.seeds.push_back(halves.seeds.front() + 1);
  std::vector<FloatImage> pictures = render_blender(session, exported, halves);
  return {std::move(pictures[0]), std::move(pictures[1])};
}

/// Nothing, with the reason on the log, where this machine or Blender has no OpenGL.
std::optional<Halves> eevee(BlenderSession& session, const ExportResult& exported,
                            const ViewCompareOptions& options) {
  BlenderViewOptions one = blender_view(session, options.render.view, options.own_materials);
  one.engine = BlenderEngine::eevee;
  one.samples = std::min(eevee_samples, one.samples);
  try {
    return Halves{render_blender(session, exported, one).front(), {}};
  } catch (const Error& error) {
    log::warn("no picture 'Eevee', which needs OpenGL: {}", error.what());
    return std::nullopt;
  }
}

/// Lightmaps that were converted.
SceneLightmaps converted(const std::filesystem::path& path, const DiffuseScene& scene) {
  SceneLightmaps lightmaps(path, scene);
  if (!lightmaps.placed().front().lightmap.metadata.is_encoded()) {
    fail(ExitCode::usage,
         "{} was not converted; of several --lightmaps the first are the bakes, and the others come from "
         "rnmbake convert",
         path.string());
  }
  return lightmaps;
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
  std::vector<SceneLightmaps> encoded;  // read before anything that takes long
  for (const std::filesystem::path& path : options.encoded)
    encoded.push_back(converted(path, exported.diffuse_scene));
  const SurfaceLights lights{&lightmaps, nullptr};
  const ViewTruth truth = trace_truth(scene, lights, options.render);
  ViewComparison view;
  view.name = camera_of(exported.diffuse_scene).name;
  view.pictures.push_back({"truth", truth.halves.mean()});
  if (options.with_cycles && exported.blends) {
    view.pictures.push_back(compared(options.own_materials ? "Cycles, own materials" : "Cycles",
                                     cycles(session, exported, options), truth));
  }
  if (options.with_eevee && exported.blends) {
    if (const auto picture = eevee(session, exported, options)) {
      view.pictures.push_back(
          compared(options.own_materials ? "Eevee, own materials" : "Eevee", *picture, truth));
    }
  }
  for (const auto& [label, variant, bytes] : decodes) {
    if (const auto why = lightmaps.obstacle(variant)) {
      log::warn("no picture '{}': {}", label, *why);
      continue;
    }
    view.pictures.push_back(
        compared(label, looked_up(scene, lights, {Lighting::Kind::decoded, variant}, options.render), truth));
    view.pictures.back().bytes = bytes;
  }
  const auto add = [&](const SceneLightmaps& shown) {
    const LightmapMetadata& metadata = shown.placed().front().lightmap.metadata;
    view.pictures.push_back(
        compared(label_of(metadata.codec),
                 looked_up(scene, {&shown, nullptr}, {Lighting::Kind::decoded, DecodeVariant::encoded},
                           options.render),
                 truth));
    view.pictures.back().bytes =
        stored_bytes(metadata.codec, make_codec(metadata.codec, {"", metadata.bases})->layers().size());
  };
  if (lightmaps.placed().front().lightmap.metadata.is_encoded()) add(lightmaps);
  for (const SceneLightmaps& one : encoded) add(one);
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
