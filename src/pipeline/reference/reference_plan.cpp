#include "pipeline/reference/reference_plan.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <variant>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr BlenderVersion first_without_tilt_clamp{3, 6, 0};  // from there on only glossy closures are bent
constexpr BlenderVersion first_that_retries{4, 0, 0};  // 3.4 does not, 4.3 does; what lies between is a guess
constexpr BlenderVersion first_with_full_footprint{5, 0, 0};
constexpr int enough_samples = 1 << 20;  // where only --error says when to stop

constexpr std::array<NamedFault, 5> known_faults{
    {{"tilt-clamp", "tilt clamp", &RecipeFaults::tilt_clamp},
     {"bump-shadowing", "bump shadowing", &RecipeFaults::bump_shadowing},
     {"self-reflection", "self-reflection", &RecipeFaults::self_reflection},
     {"below-horizon", "light from below", &RecipeFaults::below_horizon},
     {"no-diffuse", "no diffuse reflection", &RecipeFaults::no_diffuse}}};

RecipeFaults faults_named(const std::vector<std::string>& names, const std::string& where) {
  RecipeFaults faults;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known_faults, name, &NamedFault::flag);
    if (found != known_faults.end()) {
      faults.*found->on = true;
    } else if (name != "none" || names.size() > 1) {
      std::vector<std::string> flags;
      flags.reserve(known_faults.size());
      for (const NamedFault& fault : known_faults) flags.emplace_back(fault.flag);
      fail(ExitCode::usage, "{}: '{}' is no fault of the recipe; give {}, or none alone{}", where, name,
           fmt::join(flags, ", "), did_you_mean(name, flags));
    }
  }
  return faults;
}

Footprint footprint_of(ReferenceSettings::Footprint wanted, const BlenderVersion& version) {
  switch (wanted) {
    case ReferenceSettings::Footprint::centre:
      return Footprint::centre;
    case ReferenceSettings::Footprint::half:
      return Footprint::half;
    case ReferenceSettings::Footprint::full:
      return Footprint::full;
    case ReferenceSettings::Footprint::automatic:
      break;
  }
  return version >= first_with_full_footprint ? Footprint::full : Footprint::half;
}

void refuse_clamp(const std::string& where) {
  fail(ExitCode::usage, "{}: the embree engine clamps nothing; leave clamp out, or bake with engine cycles",
       where);
}

void refuse_what_only_cycles_does(const ResolvedConfig& config) {
  const BakingSettings& bake = config.globals.bake;
  if (bake.recipe == BakingSettings::Recipe::gather) {
    fail(ExitCode::usage, "{}: gather is a recipe for Cycles; leave engine embree out, or the recipe",
         config.provenance("recipe"));
  }
  if (bake.recipe == BakingSettings::Recipe::flat_normal_map) {
    fail(ExitCode::usage,
         "{}: flat-normal-map is a recipe for Cycles; leave engine embree out, or trace the recipe's errors "
         "by rnmbake reference --model flat-normal-map",
         config.provenance("recipe"));
  }
  if (bake.device != BakingSettings::Device::cpu) {
    fail(ExitCode::usage,
         "{}: the embree engine computes on the CPU; leave device out, or bake with engine cycles",
         config.provenance("device"));
  }
  if (!config.globals.run.time.empty()) {
    fail(ExitCode::usage,
         "{}: the embree engine does not go by the clock; give noise or samples, or bake with engine cycles",
         config.provenance("time"));
  }
  if (config.globals.object.clamp > 0) refuse_clamp(config.provenance("clamp"));
  for (const ObjectOverride& override_ : config.overrides()) {
    for (const SettingOverride& one : override_.values) {
      if (one.setting->key == "clamp" && std::get<double>(one.value) > 0 &&
          !config.fixed_for_all(*one.setting))
        refuse_clamp(one.where);
    }
  }
}

}  // namespace

ReferencePlan plan_reference(const ResolvedConfig& config, const std::string& scene_version) {
  const BakeSettings& settings = config.globals;
  const ReferenceSettings& wanted = settings.reference;
  const bool named = !wanted.blender_version.empty();
  ReferencePlan plan;
  plan.blender_version = named ? wanted.blender_version : scene_version;
  const BlenderVersion version =
      blender_version_of(plan.blender_version, named ? config.provenance("blender_version") : "the scene");
  follow(version, wanted.footprint, plan);
  plan.flat_normal_map = wanted.model == ReferenceSettings::Model::flat_normal_map;
  if (!wanted.faults.empty() && !plan.flat_normal_map) {
    fail(ExitCode::usage, "{}: the true model has no faults; add --model flat-normal-map",
         config.provenance("faults"));
  }
  if (plan.flat_normal_map) {
    plan.faults =
        wanted.faults.empty() ? faults_of(version) : faults_named(wanted.faults, config.provenance("faults"));
  }
  plan.error = wanted.error / 100;
  if (plan.error > 0 && config.provenance("samples") == "default") plan.most_samples = enough_samples;
  if (config.provenance("bounces") != "default") plan.bounces = settings.bake.bounces;
  plan.sh = wanted.sh;
  plan.threads = settings.run.threads;
  return plan;
}

ReferencePlan plan_traced_bake(const ResolvedConfig& config, const std::string& scene_version) {
  refuse_what_only_cycles_does(config);
  ReferencePlan plan;
  plan.is_bake = true;
  plan.blender_version = scene_version;
  follow(blender_version_of(scene_version, "the scene"), ReferenceSettings::Footprint::automatic, plan);
  plan.bounces = config.globals.bake.bounces;
  plan.threads = config.globals.run.threads;
  return plan;
}

void follow(const BlenderVersion& version, ReferenceSettings::Footprint footprint, ReferencePlan& plan) {
  plan.footprint = footprint_of(footprint, version);
  plan.past_edge = version < first_that_retries ? PastEdge::mirror : PastEdge::retry;
}

BlenderVersion blender_version_of(const std::string& text, const std::string& where) {
  BlenderVersion version;
  if (std::sscanf(text.c_str(), "%d.%d.%d", &version.major, &version.minor, &version.patch) < 2) {
    fail(ExitCode::usage, "{}: '{}' is no Blender version; give one as 3.4.1 or 4.3", where, text);
  }
  return version;
}

RecipeFaults faults_of(const BlenderVersion& version) {
  RecipeFaults faults;
  for (const NamedFault& fault : known_faults) faults.*fault.on = true;
  faults.tilt_clamp = version < first_without_tilt_clamp;
  return faults;
}

std::span<const NamedFault> all_faults() {
  return known_faults;
}

std::vector<std::string> names_of(const RecipeFaults& faults) {
  std::vector<std::string> names;
  for (const NamedFault& fault : known_faults) {
    if (faults.*fault.on) names.emplace_back(fault.flag);
  }
  return names;
}

const char* name_of(Footprint footprint) {
  switch (footprint) {
    case Footprint::centre:
      return "texel centre";
    case Footprint::half:
      return "half texel";
    case Footprint::full:
      break;
  }
  return "texel";
}

}  // namespace rnmbake
