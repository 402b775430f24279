#include "cli/bake.h"

#include "base/error.h"
#include "base/log.h"
#include "base/names.h"
#include "base/version.h"
#include "basis/basis_set.h"
#include "blender/find.h"
#include "blender/real_blender.h"
#include "cli/basis_file.h"
#include "cli/settings_flags.h"
#include "pipeline/dispatcher.h"
#include "pipeline/make_targets.h"
#include "pipeline/manifest.h"
#include "pipeline/save_scene.h"
#include "pipeline/scene_survey.h"
#include "process/stop.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

/// The directions to bake for, from --bases and --basis.
std::vector<BasisDirection> choose_bases(const BakingSettings& settings) {
  BasisSet set = rnm_set();
  if (!settings.basis.empty()) {
    BasisFile file = read_basis_file(settings.basis);
    for (const std::string& warning : file.warnings) log::warn("{}", warning);
    set = std::move(file.set);
  }
  if (!settings.basis.empty() && settings.bases.empty()) return set.directions;
  std::vector<BasisDirection> known = set.directions;
  if (std::none_of(known.begin(), known.end(),
                   [](const BasisDirection& basis) { return basis.name == "flat"; })) {
    known.push_back(flat_direction());
  }
  std::vector<BasisDirection> chosen;
  for (const std::string& name : settings.bases) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const BasisDirection& b) { return b.name == name; });
    if (found == known.end()) fail(ExitCode::usage, "no basis '{}' in {}", name, set.name);
    chosen.push_back(*found);
  }
  return chosen;
}

/// Finds out that nothing can be written there before hours of baking.
void check_output(const OutputSettings& output) {
  if (output.dir.empty())
    fail(ExitCode::usage, "no output folder: pass -o DIR, or set dir in [output] of the project file");
  make_folders(output.dir);
  AtomicFile(output.dir / "manifest.json").write(std::string(1 << 16, ' '));  // never committed
}

const char* name_of(BakingSettings::Device device) {
  using Device = BakingSettings::Device;
  switch (device) {
    case Device::cpu:
      return "CPU";
    case Device::cuda:
      return "CUDA";
    case Device::optix:
      return "OPTIX";
    case Device::hip:
      return "HIP";
    case Device::metal:
      return "METAL";
    case Device::oneapi:
      return "ONEAPI";
  }
  return "CPU";
}

const char* name_of(BakingSettings::Dispatch dispatch) {
  using Mode = BakingSettings::Dispatch;
  return dispatch == Mode::basis ? "basis" : dispatch == Mode::object ? "object" : "scene";
}

CyclesSettings cycles_settings(const BakingSettings& bake, const ObjectSettings& object) {
  return {object.samples, bake.bounces, object.seed, object.clamp, name_of(bake.device)};
}

/// What the version's bakes average a texel over (docs/accuracy.md).
const char* footprint(const BlenderVersion& version) {
  return version.major >= 5 ? "texel" : "half texel";
}

LightmapMetadata make_metadata(const BakeSettings& settings, const Target& target,
                               const ObjectSettings& object, const BlenderInfo& blender) {
  const bool receiver = settings.bake.recipe == BakingSettings::Recipe::receiver;
  LightmapMetadata metadata;
  metadata.green = target.flip_green ? Green::y_down : Green::y_up;
  metadata.normalize =
      settings.output.normalize == OutputSettings::Normalize::flat ? Normalize::flat : Normalize::none;
  metadata.recipe = receiver                     ? "receiver"
                    : settings.bake.correct_bump ? "flat-normal-map, correct-bump"
                                                 : "flat-normal-map";
  metadata.horizon = !receiver                                             ? "Blender's"
                     : object.horizon == ObjectSettings::Horizon::identity ? "identity"
                                                                           : "clamp";
  metadata.footprint = footprint(blender.version);
  metadata.samples = object.samples;
  metadata.bounces = settings.bake.bounces;
  metadata.seed = object.seed;
  metadata.rnmbake_version = version;
  metadata.blender_version = blender.version_text;
  metadata.object = target.key;
  metadata.uv_layer = target.uv_layer;
  metadata.tangent_uv_layer = target.tangent_layer;
  return metadata;
}

/// One bake from settings to manifest.
class BakeRun {
 public:
  explicit BakeRun(const ResolvedConfig& config)
      : settings_(config.globals),
        bases_(choose_bases(settings_.bake)),
        blender_(probe_version(find_blender(
                     settings_.run.blender.empty() ? std::nullopt : std::optional(settings_.run.blender))),
                 blender_options(settings_)),
        workspace_(config, blender_) {}

  int run() {
    check_output(settings_.output);
    scene_ = survey_scene(workspace_);
    list_ = make_targets(workspace_, scene_.survey);
    make_plan();
    const BakeContext context{scene_.survey, list_.targets, bases_, plan_};
    log::info("baking {} lightmaps x {} bases in {} launch{} of Blender {}", list_.targets.size(),
              bases_.size(), plan_.dispatches.size(), plan_.dispatches.size() == 1 ? "" : "es",
              blender_.info().version_text);
    DeliveryDesk desk(context, settings_.output, notes_);
    const BakeTimings timings = run_dispatches(workspace_, context, scene_.blend, desk);
    return report(desk, timings);
  }

 private:
  static RealBlender::Options blender_options(const BakeSettings& settings) {
    RealBlender::Options options;
    options.trust.allow_scripts = settings.scene.allow_scripts;
    if (!settings.run.scripts.empty()) options.scripts = settings.run.scripts;
    return options;
  }

  void make_plan() {
    FileStems stems;
    horizons_.resize(list_.targets.size());
    for (std::size_t i = 0; i < list_.targets.size(); ++i) {
      const Target& target = list_.targets[i];
      notes_.push_back({stems.take(target.key),
                        make_metadata(settings_, target, list_.settings[i], blender_.info()),
                        list_.settings[i].dilate, nullptr});
      plan_target(i);
    }
    group_units(plan_, resolve_dispatch(settings_.bake));
  }

  void plan_target(std::size_t i) {
    const Target& target = list_.targets[i];
    const bool receiver = settings_.bake.recipe == BakingSettings::Recipe::receiver;
    const CyclesSettings cycles = cycles_settings(settings_.bake, list_.settings[i]);
    if (!receiver) add_object_units(plan_, i, target, bases_, cycles);
    if (!receiver && !settings_.output.frames) return;

    const SceneObject& object = scene_.survey.objects[target.object];
    const Mesh& mesh = scene_.survey.mesh_of(object);
    const TangentFrames frames = tangent_frames(mesh, *target.tangent_uv, object.to_world);
    if (frames.degenerate_corners > 0) {
      log::info("{}: {} corners of UV layer '{}' have no direction; their tangents are arbitrary", target.key,
                frames.degenerate_corners, target.tangent_layer);
    }
    const auto surface = std::make_shared<const Surface>(
        make_surface(mesh, target.part.triangles, *target.uv, frames, object.to_world));
    bool keep_surface = settings_.output.frames;
    if (receiver) {
      std::vector<BasisDirection> bases = bases_;
      for (BasisDirection& basis : bases) basis.direction = in_frame(basis.direction, target);
      Sheets sheets = make_sheets(*surface, bases, list_.settings[i].horizon,
                                  Vec2(float(target.width), float(target.height)));
      horizons_[i] = sheets.counts;
      keep_surface |= sheets.sheets.size() > bases.size();
      add_receiver_units(plan_, i, target, std::move(sheets), bases_, cycles);
    }
    if (keep_surface) notes_[i].surface = surface;
  }

  int report(const DeliveryDesk& desk, const BakeTimings& timings) {
    const std::string with_uvs = save_scene_with_uvs(workspace_, scene_.survey, scene_.own, list_.targets);
    const auto manifest =
        make_manifest({settings_, scene_.survey, list_, bases_, notes_, horizons_, desk.deliveries(),
                       name_of(resolve_dispatch(settings_.bake)), with_uvs, timings});
    write_atomically(settings_.output.dir / "manifest.json", manifest.dump(2) + "\n");
    const auto failed =
        std::count_if(desk.deliveries().begin(), desk.deliveries().end(), [](const Delivery& delivery) {
          return !delivery || std::holds_alternative<NotDelivered>(*delivery);
        });
    const std::size_t total = list_.targets.size();
    if (failed > 0) {
      // A warning: each of them had its error already.
      log::warn("{} of {} objects failed; the others are in {}", failed, total,
                settings_.output.dir.string());
      return static_cast<int>(ExitCode::tasks_failed);
    }
    log::info("{} lightmap{} in {}, {:.1f} s", total, total == 1 ? "" : "s", settings_.output.dir.string(),
              timings.wall_seconds);
    return static_cast<int>(ExitCode::ok);
  }

  const BakeSettings& settings_;
  std::vector<BasisDirection> bases_;
  RealBlender blender_;
  Workspace workspace_;
  SurveyedScene scene_;
  TargetList list_;
  Plan plan_;
  std::vector<DeliveryNote> notes_;
  std::vector<HorizonCounts> horizons_;
};

}  // namespace

std::function<int()> add_bake_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bake", "Bake a scene into directional lightmaps");
  auto flags = std::make_shared<SettingsFlags>(*command);
  return [flags] {
    const auto config = flags->resolve();
    if (!config) return static_cast<int>(ExitCode::ok);
    StopRequest::install();
    return BakeRun(*config).run();
  };
}

}  // namespace rnmbake
