#include "pipeline/bake/bake_run.h"

#include "base/log.h"
#include "base/names.h"
#include "base/object_notes.h"
#include "base/text.h"
#include "pipeline/lightmaps/bake_collector.h"
#include "pipeline/lightmaps/manifest.h"
#include "pipeline/lightmaps/target_facts.h"
#include "pipeline/scene/save_scene.h"
#include "scene/lighting.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

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

constexpr double coarse_height = 0.1;  // texels

double distance_of(const Surface& surface) {
  return surface.triangles.empty() ? 0 : Vec3d(surface.triangles.front().corners[0].position).length();
}

class BakeRun {
 public:
  BakeRun(Workspace& workspace, const BakeSubject& subject)
      : workspace_(workspace),
        settings_(workspace.settings()),
        subject_(subject),
        list_(subject.list),
        bases_(subject.bases),
        horizons_(list_.targets.size()),
        heights_(list_.targets.size()),
        lights_(light_balls(subject.survey)) {
    plan_.fences.resize(list_.targets.size());
  }

  BakeOutcome run() {
    make_plan();
    const BakeContext context{subject_.survey, list_.targets, bases_, plan_};
    log::info("baking {} x {} in {} of Blender {}", counted(list_.targets.size(), "lightmap"),
              counted(bases_.size(), "basis"), counted(plan_.batches.size(), "launch"),
              workspace_.blender().info().version_text);
    BakeCollector collector(context, settings_.output, notes_);
    BakeOutcome outcome;
    outcome.timings = run_batches(workspace_, context, subject_.blends.shown, collector);
    outcome.deliveries = collector.deliveries();
    if (may_be_lit(subject_.survey)) warn_of_black(list_.targets, outcome.deliveries);
    write_records(outcome);
    return outcome;
  }

 private:
  /// A target whose receivers stand too high.
  struct Coarse {
    std::size_t target;
    double distance;  // from the origin
  };

  [[nodiscard]] bool by_receiver() const { return settings_.bake.recipe == BakingSettings::Recipe::receiver; }

  void make_plan() {
    FileStems stems(subject_.earlier.stems());
    for (std::size_t i = 0; i < list_.targets.size(); ++i) {
      const Target& target = list_.targets[i];
      notes_.push_back({stems.take(target.key), metadata(i), list_.settings[i].dilate, nullptr});
      plan_target(i);
    }
    lost_.warn();
    group_tasks(plan_, resolve_dispatch(settings_.bake));
    warn_of_coarse();
    warn_of_small();
    if (by_receiver()) warn_of_shadowless();
  }

  /// Cycles asks no surface whether it blocks them: a receiver does not know what is under its face.
  void warn_of_shadowless() const {
    for (const LightInfo& light : subject_.survey.lights) {
      const auto& outside = light.outside_model;
      if (std::ranges::find(outside, "no shadow") == outside.end()) continue;
      log::warn(
          "light '{}' casts no shadows: the basis maps of faces that are turned away from it take in some of "
          "its "
          "light; switch its shadows on",
          light.name);
    }
  }

  /// Cycles moves rays by lengths of its own, however small the scene.
  void warn_of_small() const {
    if (small_.empty()) return;
    log::warn(
        "{}: too small, or too far from the origin: Cycles starts rays more than a texel off its faces, and "
        "light "
        "that runs along them may reach them; scale the scene up, or move it to the origin",
        first_names(small_));
  }

  /// Floats are too coarse there, in Cycles as everywhere.
  void warn_of_coarse() const {
    if (coarse_.empty()) return;
    const auto& worst =
        *std::ranges::max_element(coarse_, {}, [&](const Coarse& it) { return heights_[it.target]; });
    const std::string more = coarse_.size() > 1 ? fmt::format(" (and {} more)", coarse_.size() - 1) : "";
    log::warn(
        "'{}'{} stands {:.0f} units from the origin, too far for 32-bit floats: shadows in its lightmap may "
        "be "
        "{:.2g} texels out of place; move the scene to the origin",
        list_.targets[worst.target].key, more, worst.distance, heights_[worst.target]);
  }

  [[nodiscard]] LightmapMetadata metadata(std::size_t i) const {
    const ObjectSettings& object = list_.settings[i];
    const BlenderInfo& blender = workspace_.blender().info();
    LightmapMetadata metadata = target_metadata(list_.targets[i], object, settings_.output);
    metadata.recipe = by_receiver()                 ? "receiver"
                      : settings_.bake.correct_bump ? "flat-normal-map, correct-bump"
                                                    : "flat-normal-map";
    metadata.horizon = !by_receiver()                                        ? "Blender's"
                       : object.horizon == ObjectSettings::Horizon::identity ? "identity"
                                                                             : "clamp";
    metadata.footprint = footprint(blender.version);
    metadata.bounces = settings_.bake.bounces;
    metadata.blender_version = blender.version_text;
    return metadata;
  }

  void plan_target(std::size_t i) {
    const Target& target = list_.targets[i];
    const CyclesSettings cycles = cycles_settings(settings_.bake, list_.settings[i]);
    if (!by_receiver()) add_object_tasks(plan_, i, target, bases_, cycles);
    if (!by_receiver() && !settings_.output.frames) return;

    const auto surface = std::make_shared<const Surface>(surface_of(subject_.survey, target, lost_));
    bool keep_surface = settings_.output.frames;
    if (by_receiver()) {
      std::vector<BasisDirection> bases = bases_;
      for (BasisDirection& basis : bases) basis.direction = in_frame(basis.direction, target);
      const Vec2 map(float(target.width), float(target.height));
      ReceiverPasses passes = make_receiver_passes(*surface, bases, list_.settings[i].horizon, map);
      Fences fences = make_fences(*surface, lights_, map);
      plan_.fences[i] = std::move(fences.strips);
      if (fences.left_out > 0) small_.push_back(target.key);
      note_glow(plan_.glow_heights, subject_.survey, target.object, *surface);
      heights_[i] = height_in_texels(*surface, map);
      if (heights_[i] > coarse_height) coarse_.push_back({i, distance_of(*surface)});
      horizons_[i] = passes.counts;
      keep_surface |= passes.passes.size() > bases.size();
      add_receiver_tasks(plan_, i, target, std::move(passes), bases_, cycles);
    }
    if (keep_surface) notes_[i].surface = surface;
  }

  void write_records(const BakeOutcome& outcome) {
    const SavedScene saved = save_scene_with_uvs(workspace_, subject_.survey, subject_.blends.own,
                                                 subject_.earlier.add_to(uvs_of(list_.targets)));
    write_manifest(
        {settings_, subject_.survey, list_, bases_, notes_, outcome.deliveries, saved, subject_.earlier,
         BakeRecord{horizons_, heights_, name_of(resolve_dispatch(settings_.bake)), outcome.timings}});
  }

  Workspace& workspace_;
  const BakeSettings& settings_;
  const BakeSubject& subject_;
  const TargetList& list_;
  const std::vector<BasisDirection>& bases_;
  Plan plan_;
  std::vector<LightmapHeader> notes_;
  std::vector<HorizonCounts> horizons_;
  LostDirections lost_;
  std::vector<double> heights_;
  std::vector<Coarse> coarse_;
  std::vector<std::string> small_;  // targets that are too small for fences
  std::vector<LightBall> lights_;
};

}  // namespace

BakeOutcome run_bake(Workspace& workspace, const BakeSubject& subject) {
  return BakeRun(workspace, subject).run();
}

}  // namespace rnmbake
