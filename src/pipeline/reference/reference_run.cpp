#include "pipeline/reference/reference_run.h"

#include "bake/assemble.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/log.h"
#include "base/names.h"
#include "base/progress.h"
#include "blender/blender_session.h"
#include "pipeline/lightmaps/manifest.h"
#include "pipeline/lightmaps/target_facts.h"
#include "process/stop.h"
#include "scene/lighting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

/// What has to be the same for targets that one call of gather() traces.
struct Kind {
  bool flip_green = false;
  int samples = 0, seed = 0;
  bool operator<(const Kind& other) const {
    return std::tie(flip_green, samples, seed) < std::tie(other.flip_green, other.samples, other.seed);
  }
};

/// Turns the y axis round: harmonics with m < 0 are odd in y.
void flip_y(std::vector<FloatImage>& sh) {
  for (const std::size_t odd : {1, 4, 5}) {  // (1,-1), (2,-2), (2,-1)
    if (odd >= sh.size()) return;
    for (float& value : sh[odd].data()) value = -value;
  }
}

/// RMS of the texels' standard errors over the mean, of the direction where that is largest.
double relative_error(const Gathered& gathered) {
  double texels = 0, worst = 0;
  for (const float covered : gathered.coverage.data()) texels += covered;
  for (const GatheredDirection& direction : gathered.directions) {
    const double mean = (direction.mean[0] + direction.mean[1] + direction.mean[2]) / 3;
    double squares = 0;
    for (const float error : direction.standard_error.data()) squares += double(error) * error;
    if (mean > 0 && texels > 0) worst = std::max(worst, std::sqrt(squares / (3 * texels)) / mean);
  }
  return worst;
}

class ReferenceRun {
 public:
  ReferenceRun(const ReferenceSubject& subject, const BakeSettings& settings, const ReferencePlan& plan,
               const std::string& title)
      : subject_(subject),
        settings_(settings),
        plan_(plan),
        list_(subject.list),
        record_{plan.flat_normal_map ? "flat-normal-map" : "true", names_of(plan.faults), plan.error,
                std::vector<ReferenceRecord::Traced>(subject.list.targets.size()),
                subject.scene.diffuse_scene().outside},
        progress_(title, progress_for(log::is_quiet(), log::is_jsonl())) {
    outcome_.deliveries.resize(list_.targets.size());
  }

  ReferenceOutcome run(const SavedScene& saved) {
    const double started = steady_clock().now();
    std::map<Kind, std::vector<std::size_t>> groups;
    FileStems stems(subject_.earlier.stems());
    LostDirections lost;
    for (std::size_t i = 0; i < list_.targets.size(); ++i) {
      const Target& target = list_.targets[i];
      auto surface =
          std::make_shared<const Surface>(surface_of(survey(), target, lost, subject_.scene.origin()));
      notes_.push_back({stems.take(target.key), metadata(i), list_.settings[i].dilate, std::move(surface)});
      const Kind kind{target.flip_green, samples(i), list_.settings[i].seed};
      groups[kind].push_back(i);
      total_ += work(i);
    }
    lost.warn();
    for (const auto& [kind, targets] : groups) trace(kind, targets);
    if (may_be_lit(survey())) warn_of_black(list_.targets, outcome_.deliveries);
    record_.wall_seconds = outcome_.wall_seconds = steady_clock().now() - started;
    write_manifest({settings_, survey(), list_, subject_.bases, notes_, outcome_.deliveries, saved,
                    subject_.earlier, record_});
    return std::move(outcome_);
  }

 private:
  [[nodiscard]] const SceneSurvey& survey() const { return subject_.scene.diffuse_scene().survey; }
  [[nodiscard]] int samples(std::size_t target) const {
    return plan_.most_samples > 0 ? plan_.most_samples : list_.settings[target].samples;
  }
  /// What the time of a target is about proportional to.
  [[nodiscard]] double work(std::size_t target) const {
    const Target& it = list_.targets[target];
    return double(it.width) * it.height * samples(target);
  }

  [[nodiscard]] LightmapMetadata metadata(std::size_t i) const {
    LightmapMetadata metadata = target_metadata(list_.targets[i], list_.settings[i], settings_.output);
    metadata.recipe = "reference";
    metadata.horizon = plan_.flat_normal_map ? "Blender's" : "exact";
    metadata.footprint = name_of(plan_.footprint);
    metadata.samples = samples(i);
    metadata.bounces = plan_.bounces;
    metadata.blender_version = plan_.blender_version;
    metadata.model = record_.model;
    metadata.faults = record_.faults.empty() ? "none" : fmt::format("{}", fmt::join(record_.faults, ","));
    metadata.error = static_cast<float>(plan_.error);
    return metadata;
  }

  [[nodiscard]] GatherOptions options_for(const Kind& kind) const {
    GatherOptions options;
    options.directions = subject_.bases;
    if (kind.flip_green) {
      for (BasisDirection& basis : options.directions) basis.direction.y = -basis.direction.y;
    }
    options.sh_order = plan_.sh;
    options.footprint = plan_.footprint;
    options.past_edge = plan_.past_edge;
    options.samples = kind.samples;
    options.error = plan_.error;
    options.bounces = plan_.bounces;
    options.seed = static_cast<std::uint64_t>(kind.seed);
    options.threads = plan_.threads;
    options.faults = plan_.faults;
    options.blender_version = plan_.blender_version;
    return options;
  }

  void trace(const Kind& kind, const std::vector<std::size_t>& targets) {
    std::vector<GatherTarget> wanted;
    double group = 0;
    for (const std::size_t i : targets) {
      const Target& target = list_.targets[i];
      wanted.push_back({notes_[i].surface.get(), target.object, target.width, target.height});
      group += work(i);
    }
    gather(
        subject_.scene, wanted, options_for(kind),
        [&](std::size_t index, Gathered&& gathered) { deliver(targets[index], std::move(gathered)); },
        [&](const GatherProgress& now) {
          progress_.update((done_ + now.share * group) / total_, list_.targets[targets[now.target]].key);
        },
        [] { return StopRequest::requested(); });
    if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
    done_ += group;
  }

  void deliver(std::size_t i, Gathered&& gathered) {
    record_.traced[i] = {gathered.paths, gathered.rays, relative_error(gathered)};
    outcome_.rays += gathered.rays;
    outcome_.deliveries[i] = finish(i, std::move(gathered));
    notes_[i].surface.reset();
  }

  Delivery finish(std::size_t i, Gathered&& gathered) const {
    const LightmapHeader& note = notes_[i];
    // Paths do not tell: where the recipe bakes black none are traced.
    if (std::ranges::none_of(gathered.coverage.data(), [](float share) { return share > 0; })) {
      const std::string reason = fmt::format(
          "no texel's centre lies in a face of '{}': are its faces smaller than a texel? Raise --resolution "
          "or --texels-per-unit",
          note.metadata.object);
      log::error("{}", reason);
      return NotDelivered{reason};
    }
    TargetBakes bakes;
    ExtraLayers extra;
    for (std::size_t k = 0; k < gathered.directions.size(); ++k) {
      const BasisDirection& basis = subject_.bases[k];
      bakes.bases.push_back({basis.name, basis.direction, std::move(gathered.directions[k].radiance)});
      extra.standard_errors.push_back({basis.name, std::move(gathered.directions[k].standard_error)});
    }
    bakes.coverage = std::move(gathered.coverage);
    if (settings_.output.frames) fill_frames(*note.surface, bakes);
    extra.validity = std::move(gathered.validity);
    extra.sh = std::move(gathered.sh);
    if (list_.targets[i].flip_green) flip_y(extra.sh);
    try {
      return deliver_lightmap(bakes, note, settings_.output, std::move(extra));
    } catch (const Error& error) {
      if (error.code() != ExitCode::tasks_failed) throw;
      log::error("{}", error.what());
      return NotDelivered{error.what()};
    }
  }

  const ReferenceSubject& subject_;
  const BakeSettings& settings_;
  const ReferencePlan& plan_;
  const TargetList& list_;
  std::vector<LightmapHeader> notes_;
  ReferenceRecord record_;
  ReferenceOutcome outcome_;
  double total_ = 0, done_ = 0;
  Progress progress_;
};

}  // namespace

ReferenceOutcome run_reference(const ReferenceSubject& subject, const BakeSettings& settings,
                               const ReferencePlan& plan, const std::string& title, const SavedScene& saved) {
  return ReferenceRun(subject, settings, plan, title).run(saved);
}

}  // namespace rnmbake
