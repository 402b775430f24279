// --materials lambert: the same scene under plain materials. Scenes: scenes/lambert_cases.py.
#include "image/layered_exr.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

nlohmann::json lambert(SurveySession& session, const fs::path& scene) {
  const LaunchOutcome outcome = session.launch(scene, "lambert_entry.py");
  if (const auto* failure = std::get_if<LaunchFailure>(&outcome)) {
    fail(ExitCode::tasks_failed, "{} {}", failure->message, failure->details);
  }
  return std::get<Finished>(outcome).result;
}

TEST(LambertWithBlender, KeepsEverythingThatASurveySees) {
  SurveySession session;
  session.build("survey_cases.py", {session.file("cases.blend").string()});
  const SceneSurvey before = session.survey(session.file("cases.blend"));
  const std::string blend = lambert(session, session.file("cases.blend")).at("blend");
  const SceneSurvey after = session.survey(session.last_folder() / blend);

  EXPECT_EQ(after.objects.size(), before.objects.size());
  EXPECT_EQ(after.lights.size(), before.lights.size());
  for (const SceneObject& object : before.objects) {
    const SceneObject* found = find_object(after, object.key);
    ASSERT_NE(found, nullptr) << object.key;
    EXPECT_EQ(found->name, object.name);
    EXPECT_EQ(found->visible_to_camera, object.visible_to_camera) << object.key;
    EXPECT_EQ(found->to_world, object.to_world) << object.key;
    if (!object.slots.empty()) {
      EXPECT_EQ(found->slots, object.slots) << object.key;
    }
    const Mesh &mesh = after.mesh_of(*found), &original = before.mesh_of(object);
    EXPECT_EQ(mesh.positions, original.positions) << object.key;
    EXPECT_EQ(mesh.triangle_loops, original.triangle_loops) << object.key;
    EXPECT_EQ(mesh.polygon_slot, original.polygon_slot) << object.key;
    EXPECT_EQ(mesh.active_uv, original.active_uv) << object.key;
    EXPECT_EQ(mesh.render_uv, original.render_uv) << object.key;
    ASSERT_EQ(mesh.uv_layers.size(), original.uv_layers.size()) << object.key;
    for (std::size_t i = 0; i < mesh.uv_layers.size(); ++i) {
      EXPECT_EQ(mesh.uv_layers[i].name, original.uv_layers[i].name) << object.key;
      EXPECT_EQ(mesh.uv_layers[i].uv, original.uv_layers[i].uv) << object.key;
    }
    ASSERT_EQ(mesh.loop_normal.size(), original.loop_normal.size()) << object.key;
    for (std::size_t i = 0; i < mesh.loop_normal.size(); ++i) {
      ASSERT_LT((mesh.loop_normal[i] - original.loop_normal[i]).length(), 1e-3) << object.key;
    }
  }
  for (const auto& [name, material] : after.materials) {
    EXPECT_TRUE(material.outside_model.empty()) << name << ": " << material.outside_model.front();
  }
}

TEST(LambertWithBlender, TakesColoursAsCyclesBakesThem) {
  SurveySession session;
  session.build("lambert_cases.py", {session.file("").string()});
  const nlohmann::json answer = lambert(session, session.file("materials.blend"));
  const std::string blend = answer.at("blend");
  EXPECT_NO_THROW(session.build("lambert_check.py", {session.file("materials.blend").string(),
                                                     (session.last_folder() / blend).string()}));
  std::string warnings;
  for (const auto& warning : answer.at("warnings")) warnings += warning.get<std::string>() + "\n";
  for (const char* name : {"'glass'", "'transmission'", "'by_ray'"}) {
    EXPECT_NE(warnings.find(name), std::string::npos) << warnings;
  }
  for (const char* name : {"'diffuse'", "'half_transparent'", "'alpha'"}) {
    EXPECT_EQ(warnings.find(name), std::string::npos) << warnings;
  }
}

using Means = std::map<std::string, FloatImage>;

void run_bake(const fs::path& scene, const fs::path& out, const std::string& materials,
              const std::string& seed) {
  ProcessOptions options;
  options.argv = {
      RNMBAKE_BINARY, "bake",    scene.string(), "-o",       out.string(), "--bases",      "flat",
      "--resolution", "16",      "--samples",    "256",      "--seed",     seed,           "--materials",
      materials,      "--depth", "float",        "--dilate", "0",          "--save-scene", "never"};
  const ProcessResult result = run_process(options);
  if (!result.succeeded()) fail(ExitCode::tasks_failed, "bake: {}", result.output);
}

/// Each file's layer of irradiance.
Means read_flat(const fs::path& folder) {
  Means result;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".exr") continue;
    const LayeredImage image = read_image(entry.path());
    if (const Layer* flat = image.find("")) result[entry.path().filename().string()] = flat->pixels;
  }
  return result;
}

/// Two bakes of one model that differ by their seeds.
struct Pair {
  Means first, second;
};

Pair bake_pair(const SurveySession& session, const std::string& materials, int seed) {
  const auto bake = [&](int number) {
    const std::string name = std::to_string(number);
    run_bake(session.file("room.blend"), session.file(name), materials, name);
    return read_flat(session.file(name));
  };
  return {bake(seed), bake(seed + 1)};
}

struct Mean {
  double value = 0, variance = 0;
};

/// Over all texels of both bakes. Their difference gives the variance: texels err independently.
Mean mean_of(const Pair& pair, const std::string& file, std::size_t channel) {
  const FloatImage &a = pair.first.at(file), &b = pair.second.at(file);
  double sum = 0, squares = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const double one = a.texel(x, y)[channel], other = b.texel(x, y)[channel];
      sum += (one + other) / 2;
      squares += (one - other) * (one - other) / 4;
    }
  }
  const auto count = double(a.texels());
  return {sum / count, squares / count / count};
}

/// Diffuse surfaces, textured and plain, lit by a sun and a textured lamp: both models are the same there.
/// Their noise is not: since Blender chooses lights by estimates of their power, it differs with the lamp's
/// material.
TEST(LambertWithBlender, ADiffuseSceneBakesAsBefore) {
  SurveySession session;
  session.build("lambert_cases.py", {session.file("").string()});
  const Pair full = bake_pair(session, "full", 1), lambert = bake_pair(session, "lambert", 3);
  EXPECT_EQ(full.first.size(), 6U);  // four walls and two instances
  for (const auto& [file, image] : full.first) {
    ASSERT_TRUE(lambert.first.contains(file)) << file;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const Mean before = mean_of(full, file, channel), after = mean_of(lambert, file, channel);
      const double noise = std::sqrt(before.variance + after.variance);
      EXPECT_GT(noise, 0);
      EXPECT_LE(std::abs(after.value - before.value), 4 * noise) << file << " channel " << channel;
      EXPECT_LT(noise, 0.01) << file;  // else nothing is tested
    }
  }
}

/// Other people's scenes, where they are at hand.
class LambertOnRealScenes : public testing::TestWithParam<const char*> {};

TEST_P(LambertOnRealScenes, LeavesOnlyPlainMaterials) {
  const fs::path scene = fs::path(RNMBAKE_SOURCE_DIR) / "../shared/scenes" / GetParam();
  if (!fs::exists(scene)) GTEST_SKIP() << scene << " is not there";
  SurveySession session;
  const SceneSurvey before = session.survey(scene);
  const std::string blend = lambert(session, scene).at("blend");
  const SceneSurvey after = session.survey(session.last_folder() / blend);
  EXPECT_EQ(after.objects.size(), before.objects.size());
  for (const SceneObject& object : before.objects) EXPECT_NE(find_object(after, object.key), nullptr);
  for (const auto& [name, material] : after.materials) EXPECT_TRUE(material.outside_model.empty()) << name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, LambertOnRealScenes,
                         testing::Values("living_room/living_room.blend", "staircase2/staircase2.blend",
                                         "house/house.glb"));

}  // namespace
}  // namespace rnmbake
