#include "cli/inspect_scene.h"
#include "cli/inspect_write.h"
#include "scene/test_meshes.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Three objects on two meshes: one with two UV layers, one without faces.
SceneSurvey small_survey() {
  SceneSurvey survey;
  survey.scene_file = "a.blend";
  survey.meshes = {square(), Mesh{}};
  survey.meshes[0].uv_layers = {{"UVMap", square_uv()}, {"Second", square_uv()}};
  survey.meshes[0].active_uv = survey.meshes[0].render_uv = 0;
  for (const auto& [key, mesh] : {std::pair{"wall", 0}, {"Säule", 0}, {"empty", 1}}) {
    SceneObject object;
    object.key = object.name = key;
    object.type = "MESH";
    object.mesh = mesh;
    survey.objects.push_back(object);
  }
  survey.materials = {{"chrome", {"chrome", false, false, {"glossy"}}},
                      {"chalk", {"chalk", true, false, {}}}};
  survey.world = "none";
  return survey;
}

ResolvedConfig config_with(const std::vector<SettingOverride>& flags = {}) {
  return resolve({}, {}, flags);
}

TEST(Inspect, ChoosesLayerAndSizeAsABakeDoes) {
  const SceneSurvey survey = small_survey();
  ResolvedConfig config = config_with();
  const Inspection inspection = inspect_scene(survey, config);
  ASSERT_EQ(inspection.objects.size(), 3U);
  EXPECT_EQ(inspection.objects[0].lightmap_layer, "Second");
  EXPECT_EQ(inspection.objects[0].tangent_layer, "UVMap");
  EXPECT_EQ(inspection.objects[0].resolution, config.globals.object.resolution);
  EXPECT_TRUE(inspection.objects[0].problems.empty());
  EXPECT_EQ(inspection.objects[2].not_baked, "no faces");
}

TEST(Inspect, GoesOnWhereABakeWouldStop) {
  SceneSurvey survey = small_survey();
  survey.meshes[0].uv_layers[1].uv.assign(6, Vec2(0));
  ResolvedConfig config = config_with();
  config.globals.object.unwrap = ObjectSettings::Unwrap::never;
  const Inspection inspection = inspect_scene(survey, config);
  EXPECT_NE(inspection.objects[0].not_baked.find("no area"), std::string::npos);
}

TEST(Inspect, CountsProblemsAtTheSizeOfTheBake) {
  SceneSurvey survey = small_survey();
  survey.meshes[0].uv_layers[1].uv = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 0}, {1, 1}};
  const Inspection inspection = inspect_scene(survey, config_with());
  ASSERT_EQ(inspection.objects[0].problems.size(), 1U);
  EXPECT_NE(inspection.objects[0].problems[0].find("texels overlap"), std::string::npos);
}

TEST(Inspect, AlignsItsTableInSpiteOfUnicode) {
  const SceneSurvey survey = small_survey();
  std::ostringstream out;
  write_inspection(survey, inspect_scene(survey, config_with()), out);
  std::istringstream lines(out.str());
  std::string header, wall, column;
  std::getline(lines, header);
  std::getline(lines, wall);
  std::getline(lines, column);
  EXPECT_EQ(header.find("TYPE"), wall.find("MESH"));
  EXPECT_EQ(header.find("TYPE") + 1, column.find("MESH"));  // one byte more, one character fewer
  EXPECT_NE(out.str().find("chrome: beyond diffuse and emission: glossy"), std::string::npos);
  EXPECT_EQ(out.str().find("chalk"), std::string::npos);
}

TEST(Inspect, GroupsInstancesAndWhatIsNotSelected) {
  SceneSurvey survey = small_survey();
  for (int i = 0; i < 1000; ++i) {
    SceneObject leaf = survey.objects[0];
    leaf.name = i < 500 ? "leaf" : "twig";
    leaf.instancer = "tree";
    leaf.key = "tree/" + leaf.name + "#" + std::to_string(i % 500);
    survey.objects.push_back(leaf);
  }
  ResolvedConfig config = config_with();
  config.globals.scene.exclude = {"twig"};
  const Inspection inspection = inspect_scene(survey, config);
  std::ostringstream out;
  write_inspection(survey, inspection, out);
  const std::string text = out.str();
  EXPECT_NE(text.find("tree/leaf#* (500)"), std::string::npos) << text;
  EXPECT_NE(text.find("not selected (500): tree/twig#0, "), std::string::npos) << text;
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 20);
  EXPECT_EQ(inspection_json(survey, inspection).at("objects").size(), 1003U);
}

TEST(Inspect, WritesJson) {
  const SceneSurvey survey = small_survey();
  const auto json = inspection_json(survey, inspect_scene(survey, config_with()));
  EXPECT_EQ(json.at("schema_version"), 1);
  EXPECT_EQ(json.at("objects").at(0).at("uv").at("overlap_texels"), 0);
  EXPECT_EQ(json.at("objects").at(2).at("baked"), false);
  EXPECT_EQ(json.at("materials").size(), 2U);
}

}  // namespace
}  // namespace rnmbake
