// rnmbake export: what of a scene reaches the tracer. Scenes: scenes/export_cases.py and the built ones.
#include "scene/diffuse_scene.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

nlohmann::json launch(SurveySession& session, const fs::path& scene, const char* entry) {
  const LaunchOutcome outcome = session.launch(scene, entry);
  if (const auto* failure = std::get_if<LaunchFailure>(&outcome))
    fail(ExitCode::tasks_failed, "{} {}", failure->message, failure->details);
  return std::get<Finished>(outcome).result;
}

DiffuseScene export_blend(SurveySession& session, const fs::path& scene) {
  const std::string blend = launch(session, scene, "lambert_entry.py").at("blend");
  const std::string survey = launch(session, session.last_folder() / blend, "export_entry.py").at("survey");
  return read_exported(session.last_folder() / survey);
}

const Texture& world_picture(const DiffuseScene& scene) {
  return scene.pictures.at(static_cast<std::size_t>(scene.world.picture));
}

Vec3 texel(const Texture& picture, const Vec2& uv) {
  const auto x = static_cast<std::size_t>(uv.x * float(picture.width));
  const auto y = static_cast<std::size_t>((1 - uv.y) * float(picture.height));
  return picture.texels[std::min(y, std::size_t(picture.height - 1)) * std::size_t(picture.width) + x];
}

/// E/pi that a picture of the world gives to a surface with that normal: the sum over all texels.
Vec3d light_from(const Texture& picture, const Vec3& normal) {
  Vec3d sum(0);
  for (int y = 0; y < picture.height; ++y) {
    const double top = pi * y / picture.height, bottom = pi * (y + 1) / picture.height;
    const double solid_angle = 2 * pi / picture.width * (std::cos(top) - std::cos(bottom));
    for (int x = 0; x < picture.width; ++x) {
      const Vec2 uv((float(x) + 0.5F) / float(picture.width), 1 - (float(y) + 0.5F) / float(picture.height));
      const double cosine = std::max(0.0F, world_direction(uv).dot(normal));
      sum += Vec3d(picture.texels[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)]) * cosine *
             solid_angle / pi;
    }
  }
  return sum;
}

/// Every face of a cube has the light that Cycles bakes on it: within five standard errors of the bake, and
/// 0.1 % for the texels of the picture.
void compare_with_bake(const DiffuseScene& scene, const fs::path& baked) {
  const nlohmann::json faces = nlohmann::json::parse(std::ifstream(baked));
  ASSERT_EQ(faces.size(), 6U);
  for (const auto& face : faces) {
    const auto normal = face.at("normal").get<std::array<float, 3>>();
    const Vec3d light = light_from(world_picture(scene), Vec3(normal[0], normal[1], normal[2]));
    const auto cycles = face.at("radiance").get<std::array<double, 3>>();
    const auto error = face.at("error").get<std::array<double, 3>>();
    for (unsigned i = 0; i < 3; ++i)
      EXPECT_NEAR(light[int(i)], cycles[i], 5 * error[i] + 0.001 * cycles[i])
          << face.dump() << " channel " << i;
  }
}

const Words* outside(const DiffuseScene& scene, const std::string& owner) {
  const auto found = std::find_if(scene.outside.begin(), scene.outside.end(),
                                  [&](const OutsideModel& one) { return one.owner == owner; });
  return found == scene.outside.end() ? nullptr : &found->what;
}

class ExportWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    session = std::make_unique<SurveySession>();
    session->build("export_cases.py", {session->file("").string()});
  }
  static void TearDownTestSuite() { session.reset(); }
  static std::unique_ptr<SurveySession> session;
};
std::unique_ptr<SurveySession> ExportWithBlender::session;

TEST_F(ExportWithBlender, WorldPictureLiesAsCyclesReadsIt) {
  const DiffuseScene scene = export_blend(*session, session->file("picture.blend"));
  ASSERT_GE(scene.world.picture, 0);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 8; ++column) {  // the picture's own cells, twice as bright
      const Vec3 seen = texel(world_picture(scene), {(float(column) + 0.5F) / 8, (float(row) + 0.5F) / 4});
      const Vec3 cell(float((7 * column + 3 * row) % 5), float((3 * column + 5 * row) % 7) / 1.5F,
                      0.5F + float(column * row) / 4);
      EXPECT_LT((seen - cell).length(), 1e-4F) << column << " " << row << ": " << seen;
    }
  }
  compare_with_bake(scene, session->file("picture.json"));
  EXPECT_EQ(outside(scene, "world"), nullptr);  // what it asks Light Path nodes is the same for all bounces
}

TEST_F(ExportWithBlender, SkyWithSunGivesTheLightThatCyclesBakes) {
  const DiffuseScene scene = export_blend(*session, session->file("sky.blend"));
  ASSERT_GE(scene.world.picture, 0);
  compare_with_bake(scene, session->file("sky.json"));
  EXPECT_EQ(outside(scene, "world"), nullptr);
}

TEST_F(ExportWithBlender, CarriesEveryThingOrSaysThatItDoesNot) {
  const DiffuseScene scene = export_blend(*session, session->file("things.blend"));
  const auto number = [&](const char* key) {
    return static_cast<std::size_t>(find_object(scene.survey, key) - scene.survey.objects.data());
  };
  ASSERT_EQ(scene.survey.objects.size(), 7U);

  const SurfaceMaterial& mapped = scene.material(number("mapped"), 0);
  ASSERT_GE(mapped.normal_map, 0);
  const NormalMap& map = scene.normal_maps[std::size_t(mapped.normal_map)];
  EXPECT_EQ(map.uv_layer, "second");
  EXPECT_FLOAT_EQ(map.strength, 0.5F);
  const Texture& normals = scene.pictures[std::size_t(map.picture)];
  EXPECT_EQ(normals.width, 4);
  EXPECT_EQ(normals.height, 2);
  EXPECT_NEAR(normals.texels[0].x, 4 / 7.0, 0.004) << "the top row comes first";
  EXPECT_NEAR(normals.texels[7].x, 3 / 7.0, 0.004);
  EXPECT_NEAR(normals.texels[0].z, 0.8, 0.004);
  const SurfaceMaterial& by_default = scene.material(number("mapped_default"), 0);
  ASSERT_GE(by_default.normal_map, 0);
  EXPECT_EQ(scene.normal_maps[std::size_t(by_default.normal_map)].uv_layer, "");
  EXPECT_EQ(scene.normal_maps[std::size_t(by_default.normal_map)].picture, map.picture);
  EXPECT_EQ(scene.material(number("bumped"), 0).normal_map, -1);
  EXPECT_EQ(outside(scene, "object 'mapped'"), nullptr);
  ASSERT_NE(outside(scene, "object 'bumped'"), nullptr);
  EXPECT_EQ(*outside(scene, "object 'bumped'"), Words{"bump"});
  ASSERT_NE(outside(scene, "object 'glass'"), nullptr);
  EXPECT_EQ(*outside(scene, "object 'glass'"), Words{"glass"});

  const SurfaceMaterial& glowing = scene.material(number("glowing"), 0);
  EXPECT_EQ(glowing.emission_picture, -1);
  EXPECT_LT((glowing.emission - Vec3(2, 4, 1)).length(), 1e-5F);
  EXPECT_EQ(glowing.albedo, Vec3(0, 0, 0));

  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(scene.takes_part(i), i != number("ghost")) << i;
  ASSERT_NE(outside(scene, "object 'shadowless'"), nullptr);
  EXPECT_EQ(*outside(scene, "object 'shadowless'"), Words{"casts no shadow"});
  ASSERT_EQ(scene.survey.lights.size(), 1U);
  EXPECT_EQ(scene.survey.lights[0].name, "lamp");
  EXPECT_EQ(outside(scene, "light 'hidden'"), nullptr);

  ASSERT_TRUE(scene.camera);
  EXPECT_TRUE(scene.camera->orthographic);
  EXPECT_NEAR(scene.camera->width, 6, 1e-5);
  EXPECT_NEAR(scene.camera->shift_x, 0.25, 1e-5);
  EXPECT_NEAR(scene.camera->shift_y, -0.5, 1e-5);
  EXPECT_EQ(scene.camera->resolution_x, 200);
  EXPECT_EQ(scene.camera->resolution_y, 100);
  EXPECT_EQ(scene.camera->to_world.translation(), Vec3d(1, 2, 3));
}

/// The built scenes through the program itself.
nlohmann::json export_built(const std::string& name, const fs::path& file) {
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY, "export",      RNMBAKE_SOURCE_DIR "/scenes/built/" + name + ".blend",
                  "-o",           file.string(), "--json",
                  "--quiet"};
  const ProcessResult result = run_process(options);
  if (!result.succeeded()) fail(ExitCode::tasks_failed, "{}: {}", name, result.output);
  return nlohmann::json::parse(result.output);
}

TEST_F(ExportWithBlender, BuiltScenesAreWhole) {
  const auto panels = export_built("panels", session->file("panels.rnmscene"));
  EXPECT_EQ(panels.at("lights"), 4);
  EXPECT_GT(panels.at("normal_maps").get<int>(), 0);
  const DiffuseScene scene = read_diffuse_scene(session->file("panels.rnmscene"));
  EXPECT_EQ(scene.survey.objects.size(), panels.at("objects").get<std::size_t>());
  EXPECT_TRUE(scene.camera);
  EXPECT_NEAR(scene.world.radiance.z, 0.55 * 0.9, 1e-5);
  for (std::size_t i = 0; i < scene.survey.objects.size(); ++i) EXPECT_GE(scene.material(i, 0).normal_map, 0);

  const auto cornell = export_built("cornell", session->file("cornell.rnmscene"));
  EXPECT_EQ(cornell.at("pictures"), 0);
  EXPECT_EQ(cornell.at("outside_model"), nlohmann::json::array());
  const DiffuseScene box = read_diffuse_scene(session->file("cornell.rnmscene"));
  const bool emissive_triangles =
      std::any_of(box.materials.begin(), box.materials.end(),
                  [](const SurfaceMaterial& material) { return material.emission.length() > 0; });
  EXPECT_TRUE(emissive_triangles);
}

}  // namespace
}  // namespace rnmbake
