#include "pipeline/gather/choose_recipe.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Recipe = BakingSettings::Recipe;

BakeSettings settings_for(Recipe recipe) {
  BakeSettings settings;
  settings.bake.recipe = recipe;
  return settings;
}

TEST(ChooseRecipe, AutoIsGatherWhereItIsExact) {
  EXPECT_EQ(choose_recipe(settings_for(Recipe::automatic), {}, {ObjectSettings{}}), Recipe::gather);
  SceneSurvey scene;
  scene.gather.refused = {"'Wall': its nodes ask"};
  EXPECT_EQ(choose_recipe(settings_for(Recipe::automatic), scene, {}), Recipe::receiver);
}

TEST(ChooseRecipe, WhatWasAskedForStays) {
  for (const Recipe recipe : {Recipe::receiver, Recipe::flat_normal_map, Recipe::gather})
    EXPECT_EQ(choose_recipe(settings_for(recipe), {}, {}), recipe);
}

TEST(ChooseRecipe, GatherThatIsNotExactIsRefusedByName) {
  SceneSurvey scene;
  scene.gather.refused = {"'Wall': its nodes ask", "'Lamp': another"};
  try {
    (void)choose_recipe(settings_for(Recipe::gather), scene, {});
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unsupported);
    EXPECT_EQ(std::string(error.what()),
              "'Wall': its nodes ask (and 1 more); or bake with --recipe receiver");
  }
}

TEST(ChooseRecipe, ClampNoiseAndTimeAreAgainstGather) {
  ObjectSettings clamped, noisy;
  clamped.clamp = 1;
  noisy.noise = 2;
  BakeSettings timed = settings_for(Recipe::automatic);
  timed.run.time = "10m";
  EXPECT_EQ(against_gather({}, {}, {ObjectSettings{}, clamped}).size(), 1U);
  EXPECT_EQ(against_gather({}, {}, {noisy}).size(), 1U);
  EXPECT_EQ(against_gather(timed, {}, {}).size(), 1U);
  EXPECT_TRUE(against_gather({}, {}, {ObjectSettings{}}).empty());
}

}  // namespace
}  // namespace rnmbake
