#include "pipeline/reference/reference_plan.h"

#include "base/error.h"
#include "config/project_file.h"
#include "config/value.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Texts = std::map<std::string, std::string>;
using Names = std::vector<std::string>;

ResolvedConfig with(const Texts& flags) {
  std::vector<SettingOverride> given;
  for (const auto& [key, text] : flags) {
    const Setting& setting = *find_setting(key);
    SettingOverride one{&setting, parse_value(setting, text, "flag"), SettingSource::flag,
                        "flag " + setting.flag()};
    given.push_back(std::move(one));
  }
  return resolve({}, {}, given);
}

std::string refusal(const Texts& flags, const std::string& version = "4.3.2") {
  try {
    (void)plan_reference(with(flags), version);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "accepted";
}

TEST(ReferencePlan, FootprintIsThatOfTheBlenderComparedWith) {
  EXPECT_EQ(plan_reference(with({}), "3.4.1").footprint, Footprint::half);
  EXPECT_EQ(plan_reference(with({}), "4.5.0").footprint, Footprint::half);
  EXPECT_EQ(plan_reference(with({}), "5.2.2 LTS").footprint, Footprint::full);
  EXPECT_EQ(plan_reference(with({{"blender_version", "5.0"}}), "3.4.1").footprint, Footprint::full);
  EXPECT_EQ(plan_reference(with({{"footprint", "centre"}}), "5.2.2").footprint, Footprint::centre);
}

TEST(ReferencePlan, PastAnEdgeItDoesAsTheBlenderComparedWith) {
  EXPECT_EQ(plan_reference(with({}), "3.4.1").past_edge, PastEdge::mirror);
  EXPECT_EQ(plan_reference(with({}), "4.3.2").past_edge, PastEdge::retry);
  EXPECT_EQ(plan_reference(with({{"blender_version", "5.2"}}), "3.4.1").past_edge, PastEdge::retry);
}

std::string refusal_of_bake(const ResolvedConfig& config) {
  try {
    (void)plan_traced_bake(config, "3.4.1");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "accepted";
}

TEST(TracedBake, GoesByTheSettingsOfBakesAlone) {
  const ReferencePlan plan = plan_traced_bake(with({{"error", "1"},
                                                    {"footprint", "centre"},
                                                    {"sh", "2"},
                                                    {"model", "flat-normal-map"},
                                                    {"threads", "3"}}),
                                              "3.4.1");
  EXPECT_TRUE(plan.is_bake);
  EXPECT_FALSE(plan.flat_normal_map);
  EXPECT_EQ(plan.error, 0);
  EXPECT_EQ(plan.sh, 0);
  EXPECT_EQ(plan.most_samples, 0);
  EXPECT_EQ(plan.footprint, Footprint::half);
  EXPECT_EQ(plan.past_edge, PastEdge::mirror);
  EXPECT_EQ(plan.bounces, 32);
  EXPECT_EQ(plan.threads, 3);
  EXPECT_EQ(plan_traced_bake(with({{"bounces", "5"}}), "5.2.2 LTS").bounces, 5);
  EXPECT_EQ(plan_traced_bake(with({}), "5.2.2 LTS").footprint, Footprint::full);
}

TEST(TracedBake, RefusesWhatOnlyCyclesDoes) {
  EXPECT_EQ(refusal_of_bake(with({{"recipe", "flat-normal-map"}})),
            "flag --recipe: flat-normal-map is a recipe for Cycles; leave engine embree out, or trace the "
            "recipe's errors by rnmbake reference --model flat-normal-map");
  EXPECT_EQ(
      refusal_of_bake(with({{"device", "CUDA"}})),
      "flag --device: the embree engine computes on the CPU; leave device out, or bake with engine cycles");
  EXPECT_EQ(refusal_of_bake(with({{"clamp", "10"}})),
            "flag --clamp: the embree engine clamps nothing; leave clamp out, or bake with engine cycles");
  EXPECT_EQ(refusal_of_bake(with({{"time", "10m"}})),
            "flag --time: the embree engine does not go by the clock; give noise or samples, or bake with "
            "engine cycles");
  EXPECT_EQ(refusal_of_bake(with({{"horizon", "clamp"}, {"dispatch", "basis"}, {"noise", "2"}})), "accepted");
}

TEST(TracedBake, RefusesTheClampOfAnOverrideThatHolds) {
  const ProjectFile project =
      parse_project("[[override]]\nobjects = [\"lamp*\"]\nclamp = 4.0\n", "hall.toml");
  EXPECT_EQ(refusal_of_bake(resolve(project, {}, {})),
            "hall.toml:3: the embree engine clamps nothing; leave clamp out, or bake with engine cycles");
  const Setting& clamp = *find_setting("clamp");
  EXPECT_EQ(
      refusal_of_bake(resolve(
          project, {}, {{&clamp, parse_value(clamp, "0", "flag"), SettingSource::flag, "flag --clamp"}})),
      "accepted");
}

TEST(ReferencePlan, TheTruthHasNoFaults) {
  const ReferencePlan plan = plan_reference(with({}), "3.4.1");
  EXPECT_FALSE(plan.flat_normal_map);
  EXPECT_FALSE(plan.faults.any());
  EXPECT_EQ(plan.blender_version, "3.4.1");
}

TEST(ReferencePlan, TheRecipeHasTheFaultsOfItsVersion) {
  const Texts recipe{{"model", "flat-normal-map"}};
  EXPECT_EQ(names_of(plan_reference(with(recipe), "3.5.1").faults),
            (Names{"tilt-clamp", "bump-shadowing", "self-reflection", "below-horizon", "no-diffuse"}));
  EXPECT_EQ(names_of(plan_reference(with(recipe), "3.6.0").faults),
            (Names{"bump-shadowing", "self-reflection", "below-horizon", "no-diffuse"}));
}

TEST(ReferencePlan, FaultsCanBeChosen) {
  const Texts one{{"model", "flat-normal-map"}, {"faults", "self-reflection,tilt-clamp"}};
  EXPECT_EQ(names_of(plan_reference(with(one), "5.2.2").faults), (Names{"tilt-clamp", "self-reflection"}));
  const Texts none{{"model", "flat-normal-map"}, {"faults", "none"}};
  EXPECT_FALSE(plan_reference(with(none), "5.2.2").faults.any());
}

TEST(ReferencePlan, WhatDoesNotFitIsNamed) {
  EXPECT_NE(refusal({{"model", "flat-normal-map"}, {"faults", "tilt-clam"}}).find("did you mean"),
            std::string::npos);
  EXPECT_NE(refusal({{"model", "flat-normal-map"}, {"faults", "none,tilt-clamp"}}).find("none alone"),
            std::string::npos);
  EXPECT_NE(refusal({{"faults", "tilt-clamp"}}).find("--model flat-normal-map"), std::string::npos);
  EXPECT_NE(refusal({{"blender_version", "four"}}).find("flag --blender-version: 'four'"), std::string::npos);
  EXPECT_NE(refusal({}, "").find("the scene: ''"), std::string::npos);
}

TEST(ReferencePlan, BouncesHaveALimitOnlyWhereOneIsSet) {
  EXPECT_EQ(plan_reference(with({}), "4.3.2").bounces, -1);
  EXPECT_EQ(plan_reference(with({{"bounces", "32"}}), "4.3.2").bounces, 32);
}

TEST(ReferencePlan, AnErrorIsAShareAndSamplesThenTheMost) {
  const ReferencePlan alone = plan_reference(with({{"error", "0.5%"}}), "4.3.2");
  EXPECT_DOUBLE_EQ(alone.error, 0.005);
  EXPECT_GT(alone.most_samples, 100000);
  EXPECT_EQ(plan_reference(with({{"error", "0.5"}, {"samples", "64"}}), "4.3.2").most_samples, 0);
  EXPECT_EQ(plan_reference(with({}), "4.3.2").most_samples, 0);
}

}  // namespace
}  // namespace rnmbake
