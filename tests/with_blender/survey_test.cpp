#include "scene/survey.h"

#include "with_blender/survey_session.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// One scene for all tests: see scenes/survey_cases.py.
class SurveyWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SurveySession session;
    session.build("survey_cases.py", {session.file("cases.blend").string()});
    survey_ = std::make_unique<SceneSurvey>(session.survey(session.file("cases.blend")));
  }
  static void TearDownTestSuite() { survey_.reset(); }

  static const SceneObject& object(const std::string& key) {
    const SceneObject* found = find_object(*survey_, key);
    if (found == nullptr) fail(ExitCode::invalid_input, "no object '{}'", key);
    return *found;
  }
  static const Mesh& mesh(const std::string& key) { return survey_->mesh_of(object(key)); }
  static bool has(const std::string& key) { return find_object(*survey_, key) != nullptr; }
  static Vec3d place(const std::string& key) {
    Vec3d result;
    object(key).to_world.multVecMatrix(Vec3d(0), result);
    return result;
  }

  static std::unique_ptr<SceneSurvey> survey_;
};

std::unique_ptr<SceneSurvey> SurveyWithBlender::survey_;

TEST_F(SurveyWithBlender, TurnsCurvesTextsAndMetaballsIntoOneMeshEach) {
  for (const auto& [key, type] :
       {std::pair{"tube", "CURVE"}, {"text", "FONT"}, {"ball", "META"}, {"surface", "SURFACE"}}) {
    EXPECT_EQ(object(key).type, type);
    EXPECT_GT(mesh(key).triangles(), 0U) << key;
    EXPECT_FALSE(has(std::string(key) + "#0") || has(std::string(key) + "/" + key + "#0")) << key;
  }
  EXPECT_FALSE(has("ball.001"));  // the family's mesh is the first one's
}

TEST_F(SurveyWithBlender, EvaluatesModifiersAsARenderDoes) {
  EXPECT_EQ(mesh("array").triangles(), 36U);
  EXPECT_EQ(mesh("viewport_only").triangles(), 12U);
  EXPECT_EQ(mesh("render_only").triangles(), 24U);
  EXPECT_EQ(mesh("levels").triangles(), 12U * 16U);
}

TEST_F(SurveyWithBlender, ShowsWhatARenderShows) {
  for (const char* key : {"in_viewport_hidden_collection", "hidden_in_viewport", "eye_closed"}) {
    EXPECT_TRUE(has(key)) << key;
  }
  for (const char* key : {"in_hidden_collection", "hidden_for_render", "in_excluded_collection", "part_a"}) {
    EXPECT_FALSE(has(key)) << key;
  }
  EXPECT_FALSE(object("not_for_camera").visible_to_camera);
  EXPECT_TRUE(object("array").visible_to_camera);
}

TEST_F(SurveyWithBlender, ListsInstancesOfCollections) {
  EXPECT_EQ(object("instancer_1/part_b#0").name, "part_b");
  EXPECT_EQ(object("instancer_1/part_b#0").instancer, "instancer_1");
  EXPECT_EQ(place("instancer_1/part_b#0"), Vec3d(20, 3, 0));
  EXPECT_EQ(object("instancer_0/part_a#0").mesh, object("instancer_1/part_a#0").mesh);
  EXPECT_EQ(object("instancer_0/part_text#0").type, "FONT");
  EXPECT_FALSE(has("instancer_0/part_text#1"));
}

TEST_F(SurveyWithBlender, ListsInstancesOfGeometryNodes) {
  EXPECT_EQ(mesh("scatter").triangles(), 2U);
  for (int number = 0; number < 4; ++number) {
    const std::string key = "scatter/scatter#" + std::to_string(number);
    EXPECT_EQ(mesh(key).triangles(), 12U) << key;
    EXPECT_EQ(object(key).mesh, object("scatter/scatter#0").mesh);
  }
  EXPECT_EQ(place("scatter/scatter#2"), Vec3d(4, 4, 0));
}

TEST_F(SurveyWithBlender, SharesMeshesAndPlacesThem) {
  EXPECT_EQ(object("shared_1").mesh, object("shared_2").mesh);
  EXPECT_EQ(object("shared_1").mesh, object("mirrored").mesh);
  EXPECT_LT(object("mirrored").to_world.determinant(), 0);
  Vec3d corner;
  object("child").to_world.multVecMatrix(Vec3d(1, 1, 1), corner);
  EXPECT_EQ(corner, Vec3d(4, 2, 9));
}

TEST_F(SurveyWithBlender, AppliesShapeKeys) {
  const auto& positions = mesh("shape_keys").positions;
  EXPECT_TRUE(std::any_of(positions.begin(), positions.end(), [](const Vec3& p) { return p.z == 9; }));
}

TEST_F(SurveyWithBlender, KnowsMaterialSlots) {
  EXPECT_EQ(object("slots").slots, (std::vector<std::string>{"red", "", "white"}));
  EXPECT_EQ(mesh("slots").polygon_slot[0], 2U);
  EXPECT_EQ(mesh("slots").polygon_slot[1], 1U);
  EXPECT_EQ(object("object_slot").slots, std::vector<std::string>{"white"});
  EXPECT_EQ(survey_->materials.size(), 2U);
}

TEST_F(SurveyWithBlender, KeepsNamesAsTheyAre) {
  for (const std::string& key :
       {std::string("../../x"), std::string("a/b"), std::string("Säule 柱"), std::string(63, 'n')}) {
    EXPECT_TRUE(has(key)) << key;
  }
}

TEST_F(SurveyWithBlender, ListsMeshesWithoutFaces) {
  EXPECT_EQ(mesh("no_faces").triangles(), 0U);
  EXPECT_FALSE(has("path_without_faces") && mesh("path_without_faces").triangles() > 0);
}

TEST_F(SurveyWithBlender, KnowsUvLayersOfObjectsSavedInEditMode) {
  EXPECT_EQ(mesh("edit_mode").uv_layers.at(0).uv.size(), 24U);
  EXPECT_EQ(mesh("second_layer").uv_layers.at(1).name, "Lightmap");
  EXPECT_EQ(mesh("second_layer").active_uv, 1);
  EXPECT_EQ(mesh("second_layer").render_uv, 0);
}

TEST_F(SurveyWithBlender, KnowsLights) {
  ASSERT_EQ(survey_->lights.size(), 4U);
  for (const LightInfo& light : survey_->lights) {
    EXPECT_EQ(light.energy, 12.5);
    EXPECT_EQ(light.color, (std::array{1.0, 0.5, 0.25}));
    EXPECT_TRUE(light.outside_model.empty()) << light.name;
  }
  EXPECT_EQ(survey_->world, "none");
}

TEST(SurveyOfACloud, NamesItsVolumeAndNoObject) {
  SurveySession session;
  session.build("cloud_case.py", {session.file("cloud.blend").string()});
  const SceneSurvey survey = session.survey(session.file("cloud.blend"));
  EXPECT_EQ(survey.objects.size(), 1U);
  ASSERT_EQ(survey.warnings.size(), 1U);
  EXPECT_TRUE(survey.warnings[0].starts_with("material 'smoke' has a volume; ")) << survey.warnings[0];
}

TEST_F(SurveyWithBlender, FindsUnitNormals) {
  for (const Mesh& mesh : survey_->meshes) {
    for (const Vec3& normal : mesh.loop_normal) {
      ASSERT_NEAR(normal.length(), 1, 1e-3) << mesh.name;
    }
  }
}

}  // namespace
}  // namespace rnmbake
