#include "pipeline/scene/make_targets.h"

#include "base/error.h"
#include "scene/lighting.h"
#include "scene/test_meshes.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Two triangles on a line.
Mesh line() {
  return triangle_mesh({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}}, {0, 1, 2, 1, 2, 3},
                       std::vector<Vec3>(6, Vec3(0, 0, 1)));
}

/// The square, and beside it a triangle of no area.
Mesh square_with_line() {
  Mesh mesh = triangle_mesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {5, 5, 5}, {6, 6, 6}, {8, 8, 8}},
                            {0, 1, 2, 0, 2, 3, 4, 5, 6}, std::vector<Vec3>(9, Vec3(0, 0, 1)));
  return mesh;
}

SceneSurvey survey_of(std::vector<Mesh> meshes) {
  SceneSurvey survey;
  survey.scene_file = "a.blend";
  survey.world = "constant";
  survey.world_strength = 1;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    SceneObject object;
    object.key = object.name = "object" + std::to_string(i);
    object.mesh = static_cast<int>(i);
    survey.objects.push_back(object);
  }
  survey.meshes = std::move(meshes);
  return survey;
}

Mesh with_layer(Mesh mesh, const std::vector<Vec2>& uv) {
  mesh.uv_layers = {{"Lightmap", uv}};
  return mesh;
}

TargetList targets_of(const SceneSurvey& survey, const std::vector<SettingOverride>& flags = {}) {
  return make_targets(resolve({}, {}, flags), survey);
}

TEST(MakeTargets, LeavesOutWhatHasNoArea) {
  const TargetList list =
      targets_of(survey_of({line(), square_with_line(), with_layer(line(), square_uv())}));
  ASSERT_EQ(list.targets.size(), 1U);
  EXPECT_EQ(list.targets[0].key, "object1");
  EXPECT_TRUE(list.targets[0].unwrapped);
  EXPECT_EQ(list.targets[0].uv_report.degenerate_world, 1U);
  EXPECT_EQ(list.targets[0].uv_report.degenerate_uv, 0U);
  ASSERT_EQ(list.skipped.size(), 2U);
  EXPECT_EQ(list.skipped[0].key, "object0");
  EXPECT_EQ(list.skipped[0].reason, "no area");
}

TEST(MakeTargets, LeavesOutPartsWithoutArea) {
  ResolvedConfig config = resolve({}, {}, {});
  config.globals.object.split = ObjectSettings::Split::loose;
  const TargetList list = make_targets(config, survey_of({square_with_line()}));
  ASSERT_EQ(list.targets.size(), 1U);
  EXPECT_EQ(list.targets[0].key, "object0/part0");
  ASSERT_EQ(list.skipped.size(), 1U);
  EXPECT_EQ(list.skipped[0].key, "object0/part1");
}

TEST(MakeTargets, RefusesToUnwrapWhereNoLayerIsLeft) {
  Mesh mesh = with_layer(square_with_line(), square_uv());
  for (int i = 1; i < 8; ++i) mesh.uv_layers.push_back({std::to_string(i), mesh.uv_layers[0].uv});
  ResolvedConfig config = resolve({}, {}, {});
  config.globals.object.unwrap = ObjectSettings::Unwrap::always;
  EXPECT_NO_THROW(make_targets(config, survey_of({mesh})));  // one is called Lightmap already
  mesh.uv_layers[0].name = "0";
  EXPECT_THROW(make_targets(config, survey_of({mesh})), Error);
  config.globals.output.save_scene = OutputSettings::SaveScene::never;
  EXPECT_NO_THROW(make_targets(config, survey_of({mesh})));
  config.globals.output.save_scene = OutputSettings::SaveScene::when_unwrapped;
  mesh.uv_layers.pop_back();
  EXPECT_NO_THROW(make_targets(config, survey_of({mesh})));
}

TEST(MakeTargets, CountsWhatTheLightmapCannotShow) {
  std::vector<Vec2> doubled = square_uv();  // the second triangle on top of the first
  std::copy(doubled.begin(), doubled.begin() + 3, doubled.begin() + 3);
  std::vector<Vec2> in_tile = square_uv();  // the second triangle in tile 1002
  for (std::size_t i = 3; i < 6; ++i) in_tile[i].x += 1;
  const TargetList list = targets_of(survey_of(
      {with_layer(square(), doubled), with_layer(square(), in_tile), with_layer(square(), square_uv())}));
  ASSERT_EQ(list.targets.size(), 3U);
  EXPECT_GT(list.targets[0].uv_report.overlap_texels, 256U * 256U / 2 - 256U);
  EXPECT_EQ(list.targets[1].uv_report.tile_triangles, 1U);
  EXPECT_TRUE(list.targets[2].uv_report.clean());
}

TEST(MakeTargets, KnowsTheSizeThatWasAskedFor) {
  ResolvedConfig config = resolve({}, {}, {});
  config.globals.object.texels_per_unit = 100;
  config.globals.object.max_resolution = 64;
  const TargetList list = make_targets(config, survey_of({with_layer(square(), square_uv())}));
  EXPECT_EQ(list.targets.at(0).width, 64);
  EXPECT_EQ(list.targets.at(0).wanted_side, 200);
}

TEST(MakeTargets, UnwrapsInstancesOnceAndKeepsTheMargin) {
  SceneSurvey survey = survey_of({square(), square()});
  survey.objects[1].mesh = 0;
  survey.objects[1].to_world.setTranslation(Vec3d(5, 0, 0));
  const TargetList list = targets_of(survey);
  ASSERT_EQ(list.targets.size(), 2U);
  EXPECT_EQ(list.targets[0].uv, list.targets[1].uv);
  for (const Vec2& uv : *list.targets[0].uv) {  // half the margin of 4 texels stays to the border
    EXPECT_GE(std::min(uv.x, uv.y), 2.0F / 256 - 1e-6F);
    EXPECT_LE(std::max(uv.x, uv.y), 1 - 2.0F / 256 + 1e-6F);
  }
}

TEST(CheckLight, RefusesADarkSceneUnlessAskedFor) {
  SceneSurvey survey = survey_of({square()});
  survey.world_strength = 0;
  try {
    check_light(resolve({}, {}, {}), survey);
    ADD_FAILURE() << "it was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_NE(std::string(error.what()).find("--allow-dark"), std::string::npos);
  }
  ResolvedConfig config = resolve({}, {}, {});
  config.globals.scene.allow_dark = true;
  EXPECT_NO_THROW(check_light(config, survey));
}

LightInfo lamp(double energy, const std::array<double, 3>& color,
               const std::vector<std::string>& outside_model = {}) {
  LightInfo light;
  light.energy = energy;
  light.color = color;
  light.outside_model = outside_model;
  return light;
}

TEST(MayBeLit, IsFalseOnlyWhereNothingCanGiveLight) {
  SceneSurvey dark;
  dark.world = "none";
  EXPECT_FALSE(may_be_lit(dark));
  dark.materials["wall"] = {"wall", false, false, {"glossy"}};
  dark.lights.push_back(lamp(0, {1, 1, 1}));
  dark.lights.push_back(lamp(1, {0, 0, 0}));
  dark.lights.push_back(lamp(1, {1, 1, 1}, {"portal"}));
  EXPECT_FALSE(may_be_lit(dark));

  SceneSurvey lit = dark;
  lit.lights.push_back(lamp(1, {1, 0, 0}));
  EXPECT_TRUE(may_be_lit(lit));
  lit = dark;
  lit.lights.push_back(lamp(0, {1, 1, 1}, {"node tree"}));
  EXPECT_TRUE(may_be_lit(lit));
  lit = dark;
  lit.materials["glow"] = {"glow", false, true, {}};
  EXPECT_TRUE(may_be_lit(lit));
  lit = dark;
  lit.materials["fire"] = {"fire", false, false, {"volume"}};
  EXPECT_TRUE(may_be_lit(lit));
  lit = dark;
  lit.world = "nodes";
  EXPECT_TRUE(may_be_lit(lit));
}

}  // namespace
}  // namespace rnmbake
