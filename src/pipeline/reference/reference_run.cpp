#include "pipeline/reference/reference_run.h"

#include "bake/assemble.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/names.h"
#include "base/progress.h"
#include "base/text.h"
#include "blender/blender_session.h"
#include "config/recipe_names.h"
#include "encoding/flip_green.h"
#include "pipeline/lightmaps/manifest.h"
#include "pipeline/lightmaps/target_facts.h"
#include "process/stop.h"
#include "scene/lighting.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

/// Settings that targets of one call of gather() share.
struct Kind {
  bool flip_green = false;
  int samples = 0, seed = 0;
  double error = 0;
  bool operator<(const Kind& other) const {
    return std::tie(flip_green, samples, seed, error) <
           std::tie(other.flip_green, other.samples, other.seed, other.error);
  }
};

/// The same harmonics in a tangent space whose y axis is turned round.
void flip_harmonics(std::vector<FloatImage>& sh) {
  for (const std::size_t odd : sh_odd_in_y) {
    if (odd >= sh.size()) return;
    for (float& value : sh[odd].data()) value = -value;
  }
}

/// RMS of the texels' standard errors over their mean; the largest of all directions.
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

/// Paths for each covered texel; blocks of texels have more or fewer where an error was asked for.
int mean_samples(const Gathered& gathered) {
  double texels = 0;
  for (const float covered : gathered.coverage.data()) texels += covered;
  return texels > 0 ? static_cast<int>(std::lround(double(gathered.paths) / texels)) : 0;
}

/// Input of every step.
struct ReferenceInput {
  const ReferenceSubject& subject;
  const BakeSettings& settings;
  const ReferencePlan& plan;

  [[nodiscard]] const std::vector<Target>& targets() const { return subject.list.targets; }
  [[nodiscard]] const DiffuseScene& scene() const { return subject.scene.diffuse_scene(); }
  [[nodiscard]] int samples(std::size_t target) const {
    return plan.most_samples > 0 ? plan.most_samples : subject.list.settings[target].samples;
  }
  /// Relative standard error that is enough; 0: the samples decide.
  [[nodiscard]] double error(std::size_t target) const {
    return plan.is_bake ? subject.list.settings[target].noise / 100 : plan.error;
  }
  /// Texels x samples, to which the time of a target is about proportional.
  [[nodiscard]] double work(std::size_t target) const {
    return double(targets()[target].width) * targets()[target].height * samples(target);
  }
};

/// Headers, record and outcome, filled target by target.
struct ReferenceResult {
  std::vector<LightmapHeader> headers;  // [targets]
  ReferenceRecord record;
  ReferenceOutcome outcome;
};

ReferenceRecord new_record(const ReferenceInput& input) {
  using Model = ReferenceSettings::Model;
  return {name_of(input.plan.flat_normal_map ? Model::flat_normal_map : Model::truth),
          names_of(input.plan.faults),
          input.plan.error,
          std::vector<ReferenceRecord::Traced>(input.targets().size()),
          input.scene().outside,
          0,
          input.plan.is_bake};
}

LightmapMetadata metadata_of(const ReferenceInput& input, const ReferenceRecord& record, std::size_t i) {
  const ReferencePlan& plan = input.plan;
  LightmapMetadata metadata =
      target_metadata(input.targets()[i], input.subject.list.settings[i], input.settings.output);
  metadata.recipe = plan.is_bake ? traced_name : "reference";
  metadata.horizon = plan.flat_normal_map ? "Blender's" : "exact";
  metadata.footprint = name_of(plan.footprint);
  metadata.samples = input.samples(i);
  metadata.bounces = plan.bounces;
  metadata.blender_version = plan.blender_version;
  if (plan.is_bake) {
    metadata.engine = name_of(BakingSettings::Engine::embree);
    return metadata;
  }
  metadata.model = record.model;
  metadata.faults = record.faults.empty() ? "none" : fmt::format("{}", fmt::join(record.faults, ","));
  metadata.error = static_cast<float>(plan.error);
  return metadata;
}

std::vector<LightmapHeader> headers_of(const ReferenceInput& input, const ReferenceRecord& record) {
  std::vector<LightmapHeader> headers;
  FileStems stems(input.subject.earlier.stems());
  LostDirections lost;
  for (std::size_t i = 0; i < input.targets().size(); ++i) {
    const Target& target = input.targets()[i];
    auto surface = std::make_shared<const Surface>(
        surface_of(input.scene().survey, target, lost, input.subject.scene.origin()));
    headers.push_back({stems.take(target.key), metadata_of(input, record, i),
                       input.subject.list.settings[i].dilate, std::move(surface)});
  }
  lost.warn();
  return headers;
}

GatherOptions options_for(const ReferenceInput& input, const Kind& kind) {
  const ReferencePlan& plan = input.plan;
  GatherOptions options;
  options.directions = input.subject.bases;
  if (kind.flip_green) {
    for (BasisDirection& basis : options.directions) basis.direction = flip_green(basis.direction);
  }
  options.sh_order = plan.sh;
  options.footprint = plan.footprint;
  options.past_edge = plan.past_edge;
  options.samples = kind.samples;
  options.error = kind.error;
  options.bounces = plan.bounces;
  options.seed = static_cast<std::uint64_t>(kind.seed);
  options.threads = plan.threads;
  options.faults = plan.faults;
  options.blender_version = plan.blender_version;
  return options;
}

/// Writes one target's files; logs the reason where there are none.
Delivery delivered(const ReferenceInput& input, const LightmapHeader& header, bool y_down,
                   Gathered&& gathered) {
  // The number of paths cannot decide this: where the recipe bakes black none are traced.
  if (std::ranges::none_of(gathered.coverage.data(), [](float share) { return share > 0; })) {
    const std::string reason = fmt::format(
        "no texel's centre lies in a face of '{}': are its faces smaller than a texel? Raise --resolution "
        "or --texels-per-unit",
        header.metadata.object);
    return not_delivered(header.metadata.object, reason, reason);
  }
  TargetBakes bakes;
  ExtraLayers extra;
  const bool with_errors = !input.plan.is_bake || has_error_layers(input.settings.output);
  for (std::size_t k = 0; k < gathered.directions.size(); ++k) {
    const BasisDirection& basis = input.subject.bases[k];
    bakes.bases.push_back({basis.name, basis.direction, std::move(gathered.directions[k].radiance)});
    if (with_errors)
      extra.standard_errors.push_back({basis.name, std::move(gathered.directions[k].standard_error)});
  }
  bakes.coverage = std::move(gathered.coverage);
  if (input.settings.output.frames) fill_frames(*header.surface, bakes);
  if (!input.plan.is_bake) extra.validity = std::move(gathered.validity);
  extra.sh = std::move(gathered.sh);
  if (y_down) flip_harmonics(extra.sh);
  try {
    return deliver_lightmap(bakes, header, input.settings.output, std::move(extra));
  } catch (const Error& error) {
    if (error.code() != ExitCode::tasks_failed) throw;
    return not_delivered(header.metadata.object, error.what(), error.what());
  }
}

/// Targets of one call of gather(), with what is kept of them.
struct Group {
  Kind kind;
  std::vector<std::size_t> targets;
  std::vector<GatherTarget> wanted;
  GatherOptions options;
  std::unique_ptr<KeptTraces> kept;
  std::vector<bool> is_kept;  // [targets]
  double work = 0;            // without what is kept
};

std::vector<Group> groups_of(const ReferenceInput& input, const std::vector<LightmapHeader>& headers) {
  std::map<Kind, std::vector<std::size_t>> by_kind;
  for (std::size_t i = 0; i < input.targets().size(); ++i) {
    const Kind kind{input.targets()[i].flip_green, input.samples(i), input.subject.list.settings[i].seed,
                    input.error(i)};
    by_kind[kind].push_back(i);
  }
  std::vector<Group> groups;
  for (auto& [kind, targets] : by_kind) {
    Group& group = groups.emplace_back();
    group.kind = kind;
    group.options = options_for(input, kind);
    for (const std::size_t i : targets) {
      const Target& target = input.targets()[i];
      group.wanted.push_back(
          {headers[i].surface.get(), target.object, target.width, target.height, hash64(target.key)});
    }
    group.kept = std::make_unique<KeptTraces>(input.subject.kept, group.wanted, group.options);
    for (std::size_t k = 0; k < targets.size(); ++k) {
      group.is_kept.push_back(group.kept->has(k));
      if (!group.is_kept.back()) group.work += input.work(targets[k]);
    }
    group.targets = std::move(targets);
  }
  return groups;
}

/// Traces a group and writes each target as soon as it is complete. `show` gets the share of all work of this
/// call that is done, and the target at work.
void trace(const ReferenceInput& input, Group& group, const std::function<void(double, const Target&)>& show,
           ReferenceResult& result) {
  const auto take = [&](std::size_t index, Gathered&& gathered) {
    const std::size_t i = group.targets[index];
    result.record.traced[i] = {gathered.paths, gathered.rays, relative_error(gathered)};
    if (!group.is_kept[index]) result.outcome.rays += gathered.rays;
    if (input.plan.is_bake && group.kind.error > 0)
      result.headers[i].metadata.samples = mean_samples(gathered);
    result.outcome.deliveries[i] =
        delivered(input, result.headers[i], group.kind.flip_green, std::move(gathered));
    result.headers[i].surface.reset();
  };
  gather(
      input.subject.scene, group.wanted, group.options, take,
      [&](const GatherProgress& now) { show(now.share, input.targets()[group.targets[now.target]]); },
      [] { return StopRequest::requested(); }, group.kept.get());
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
}

/// Traces group after group.
void trace_all(const ReferenceInput& input, const std::string& title, ReferenceResult& result) {
  std::vector<Group> groups = groups_of(input, result.headers);
  double total = 0, done = 0;
  std::ptrdiff_t kept = 0;
  for (const Group& group : groups) {
    total += group.work;
    kept += std::ranges::count(group.is_kept, true);
  }
  if (kept > 0) log::info("{} of {} traced before", kept, counted(input.targets().size(), "target"));
  Progress progress(title, progress_for(log::is_quiet(), log::is_jsonl()));
  for (Group& group : groups) {
    const auto show = [&](double share, const Target& target) {
      progress.update((done + share * group.work) / std::max(1.0, total), target.key);
    };
    trace(input, group, show, result);
    done += group.work;
  }
}

}  // namespace

ReferenceOutcome run_reference(const ReferenceSubject& subject, const BakeSettings& settings,
                               const ReferencePlan& plan, const std::string& title, const SavedScene& saved) {
  const double started = steady_clock().now();
  const ReferenceInput input{subject, settings, plan};
  ReferenceResult result{{}, new_record(input), {}};
  result.headers = headers_of(input, result.record);
  result.outcome.deliveries.resize(subject.list.targets.size());
  trace_all(input, title, result);
  const SceneSurvey& survey = input.scene().survey;
  if (may_be_lit(survey)) warn_of_black(subject.list.targets, result.outcome.deliveries);
  result.record.wall_seconds = result.outcome.wall_seconds = steady_clock().now() - started;
  write_manifest({settings, survey, subject.list, subject.bases, result.headers, result.outcome.deliveries,
                  saved, subject.earlier, result.record});
  return std::move(result.outcome);
}

}  // namespace rnmbake
