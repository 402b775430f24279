#include "cli/render.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/names.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/flags/command_line.h"
#include "cli/flags/render_flags.h"
#include "image/display_png.h"
#include "image/layered_exr.h"
#include "pipeline/lightmaps/deliver_lightmap.h"
#include "pipeline/reference/reference_plan.h"
#include "pipeline/render/compare_probes.h"
#include "pipeline/render/render_blender.h"
#include "pipeline/render/render_compare.h"
#include "pipeline/render/render_gbuffer.h"
#include "pipeline/scene/export_scene.h"
#include "pipeline/scene/fit_camera.h"
#include "process/stop.h"
#include "report/write.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr int traced_samples = 256, looked_up_samples = 16;

/// Exported scene with its tracer, its lightmaps, and the Blender that Cycles' pictures come from.
class OpenScene {
 public:
  OpenScene(const ResolvedConfig& config, const RenderFlags& flags)
      : config_(config),
        flags_(flags),
        decode_(flags.decode),
        blender_(config.globals),
        session_(config_, blender_),
        exported_(opened()),
        probes_(opened_probes()),
        plan_(plan_reference(config_, exported_.diffuse_scene.survey.blender_version)),
        scene_(exported_.diffuse_scene, plan_.blender_version) {
    if (!flags.lightmaps.empty()) lightmaps_.emplace(flags.lightmaps.front(), exported_.diffuse_scene);
    if (lightmaps_ && !lightmaps_->bare().empty())
      log::warn("no lightmap, so traced: {}", fmt::join(lightmaps_->bare(), ", "));
    if (lightmaps_ && flags.decode_by_header)
      decode_ = name_of(natural_variant(lightmaps_->placed().front().lightmap.metadata));
  }

  void write_picture() {
    const RenderOptions options = render_options(!flags_.with.empty());
    if (flags_.gbuffer) return write_gbuffer(options.view);
    if (!flags_.with.empty()) return write({by_blender(options.view), {}, {}});
    Lighting lighting = *lighting_of(decode_);
    lighting.lookup = lookup();
    write(render_view(scene_, lights(), lighting, options));
  }

  [[nodiscard]] Report compare() {
    ViewCompareOptions options;
    options.render = render_options(true);
    options.own_materials = flags_.materials == "full";
    options.with_eevee = flags_.with == "eevee";
    if (flags_.lightmaps.size() > 1)
      options.encoded.assign(flags_.lightmaps.begin() + 1, flags_.lightmaps.end());
    Report report;
    report.views.push_back(probes_ ? compare_probes_view(scene_, lights(), options.render)
                                   : compare_view(session_, exported_, scene_, *lightmaps_, options));
    report.finding = finding_of(report.views.front());
    const ViewOptions& view = options.render.view;
    report.settings = {{"size", fmt::format("{} x {}", view.width, view.height)},
                       {"samples", fmt::format("{} of what is traced", view.samples)},
                       {probes_ ? "probes" : "lightmaps",
                        probes_ ? flags_.probes.string() : flags_.lightmaps.front().string()},
                       {"Blender's materials", flags_.materials}};
    report.versions = {{"Blender", plan_.blender_version}};
    return report;
  }

 private:
  ExportResult opened() {
    if (!is_rnmscene(config_.globals.scene.file)) (void)blender_.info();
    ExportResult exported = flags_.lightmaps.empty() ? export_surfaces(session_) : export_scene(session_);
    give_camera(exported, flags_.camera == "fit", flags_.size());
    return exported;
  }

  /// Before the scene is traced, to which spheres are added.
  [[nodiscard]] std::optional<SceneProbes> opened_probes() {
    if (flags_.probes.empty()) return std::nullopt;
    SceneProbes probes(flags_.probes, exported_.diffuse_scene, flags_.dynamic);
    if (flags_.spheres) probes.show_spheres(exported_.diffuse_scene);
    return probes;
  }

  [[nodiscard]] const SceneLightmaps* lightmaps() const { return lightmaps_ ? &*lightmaps_ : nullptr; }

  [[nodiscard]] SurfaceLights lights() const { return {lightmaps(), probes_ ? &*probes_ : nullptr}; }

  [[nodiscard]] ProbeLookup lookup() const {
    ProbeLookup lookup{*probe_encoding_of(flags_.probes_as), LeakTest::validity};
    if (!flags_.leak_test.empty()) {
      lookup.test = *leak_test_of(flags_.leak_test);
    } else if (probes_) {
      lookup.test = leak_tests_for(probes_->volumes()).back();
    }
    return lookup;
  }

  void write_gbuffer(const ViewOptions& options) const {
    const LayeredImage image =
        gbuffer_layers(render_gbuffer(scene_, lightmaps(), options), exported_.diffuse_scene);
    write_exr(flags_.output, image, Depth::full);
  }

  [[nodiscard]] RenderOptions render_options(bool by_blender) const {
    RenderOptions options = rnmbake::render_options(camera_of(exported_.diffuse_scene));
    if (const auto size = flags_.size()) std::tie(options.view.width, options.view.height) = *size;
    const bool traced = by_blender || decode_ == "truth";
    options.view.samples = flags_.samples > 0 ? flags_.samples : traced ? traced_samples : looked_up_samples;
    options.view.seed = static_cast<std::uint64_t>(config_.globals.object.seed);
    options.view.threads = plan_.threads;
    options.bounces = plan_.bounces;
    return options;
  }

  [[nodiscard]] FloatImage by_blender(const ViewOptions& view) {
    BlenderViewOptions options = blender_view(session_, view, flags_.materials == "full");
    if (flags_.with == "eevee") options.engine = BlenderEngine::eevee;
    return std::move(render_blender(session_, exported_, options).front());
  }

  void write(View&& view) const {
    if (is_png(flags_.output)) return write_display_png(flags_.output, view.beauty, flags_.exposure);
    LayeredImage image;
    image.layers.push_back({"", {"R", "G", "B"}, std::move(view.beauty)});
    if (!view.albedo.empty()) image.layers.push_back({"albedo", {"R", "G", "B"}, std::move(view.albedo)});
    if (!view.coverage.empty()) image.layers.push_back({"coverage", {""}, std::move(view.coverage)});
    image.attributes["rnmbake:rendered"] = flags_.with.empty() ? decode_ : flags_.with;
    write_exr(flags_.output, image, Depth::full);
  }

  const ResolvedConfig& config_;
  const RenderFlags& flags_;
  std::string decode_;
  LateBlender blender_;
  BlenderSession session_;
  ExportResult exported_;
  std::optional<SceneProbes> probes_;
  ReferencePlan plan_;
  TraceScene scene_;
  std::optional<SceneLightmaps> lightmaps_;
};

void write_comparison(Report report, const ResolvedConfig& config, const RenderFlags& flags) {
  report.title = config.globals.scene.file.filename().string() + ": one view, several ways to light it";
  report.command = command_line("render", config) + flags.as_text();
  for (const ViewPicture& picture : report.views.front().pictures) {
    LayeredImage image;
    image.layers.push_back({"", {"R", "G", "B"}, picture.picture});
    write_exr(flags.output / (file_word(picture.label) + ".exr"), image, Depth::full);
  }
  write_report(report, flags.output);
  std::cout << printable(report.finding) << '\n';
  log::info("report: {}", (flags.output / "report.html").string());
}

int render(ResolvedConfig config, const RenderFlags& flags) {
  const auto saved =
      flags.lightmaps.empty() ? std::nullopt : scene_with_lightmap_uvs(flags.lightmaps.front());
  if (saved && !is_rnmscene(config.globals.scene.file)) {
    log::info("opening {}, which has the UVs that were made for these lightmaps", saved->string());
    config.globals.scene.file = *saved;
  }
  std::optional<FolderLock> lock;
  if (flags.compare) {
    OutputSettings output;
    output.dir = flags.output;
    lock.emplace(prepare_output(output, config.globals.run));
  } else {
    AtomicFile(flags.output).write(" ");  // never committed: finds out now that nothing can be written there
  }
  OpenScene scene(config, flags);
  if (flags.compare) {
    write_comparison(scene.compare(), config, flags);
  } else {
    scene.write_picture();
  }
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_render_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("render", "Show a scene from its camera, lit by lightmaps, traced, or by Cycles");
  auto flags = std::make_shared<RenderFlags>(*command);
  return [flags] {
    flags->check();
    const auto config = flags->settings.resolve();
    if (!config) return static_cast<int>(ExitCode::ok);
    StopRequest::install();
    return render(*config, *flags);
  };
}

}  // namespace rnmbake
