#include "pipeline/lightmaps/earlier_lightmaps.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/basis_set.h"
#include "pipeline/fixture.h"
#include "pipeline/reference/reference_run.h"
#include "pipeline/traced_scene.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

/// A folder into which references of two objects are traced, of both or of one of them.
class TwoObjects : public testing::Test {
 protected:
  TwoObjects() : config_(resolve({}, {}, {})) {
    add_object(exported_.diffuse_scene, "wall", {level(1, 2)}, Vec3(0.5F));
    add_target(exported_, 1, 8);
    config_.globals.output.dir = folder_.path();
    config_.globals.scene.file = "scene.blend";
    plan_.blender_version = "4.3.2";
  }

  /// `objects`: how many of the two, from the first on.
  void trace(std::size_t objects) {
    TargetList list = exported_.list;
    list.targets.resize(objects);
    list.settings.resize(objects);
    if (objects < 2) list.skipped.push_back({"wall", "not selected"});
    BlenderSession session(config_, blender_);
    const EarlierLightmaps earlier =
        find_earlier(session, {kind_, bases_}, exported_.diffuse_scene.survey, list.targets);
    const TraceScene scene(exported_.diffuse_scene, plan_.blender_version);
    (void)run_reference({scene, list, bases_, earlier}, config_.globals, plan_);
  }

  [[nodiscard]] nlohmann::json manifest() const {
    return nlohmann::json::parse(read_text(folder_.path() / "manifest.json"));
  }
  [[nodiscard]] std::vector<std::string> keys() const {
    std::vector<std::string> all;
    const nlohmann::json read = manifest();
    for (const auto& entry : read.at("objects")) all.push_back(entry.at("key"));
    return all;
  }
  void expect_refusal(const std::string& about) {
    try {
      trace(1);
      FAIL() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find(about), std::string::npos) << error.what();
    }
    EXPECT_EQ(keys(), both_);
  }

  const std::vector<std::string> both_{"floor", "wall"}, floor_{"floor"};
  TempFolder folder_;
  ResolvedConfig config_;
  FakeBlender blender_;
  ExportResult exported_ = floor_under_sky();
  ReferencePlan plan_;
  std::vector<BasisDirection> bases_ = flat_and_rnm().directions;
  std::string kind_ = "reference";
};

TEST_F(TwoObjects, WhatIsLeftAloneStays) {
  trace(2);
  const nlohmann::json before = manifest().at("objects").at(1);
  EXPECT_FALSE(before.contains("earlier"));
  plan_.error = 0.1;
  trace(1);
  ASSERT_EQ(keys(), both_);
  nlohmann::json after = manifest().at("objects").at(1);
  EXPECT_EQ(after.at("earlier").at("error"), 0);
  EXPECT_EQ(after.at("earlier").at("recipe"), "reference");
  EXPECT_EQ(after.at("earlier").at("footprint"), "half texel");
  plan_.error = 0.2;
  trace(1);
  EXPECT_EQ(manifest().at("objects").at(1), after);  // of its own run, not of the one between
  after.erase("earlier");
  EXPECT_EQ(after, before);
  EXPECT_EQ(manifest().at("skipped"), nlohmann::json::array());
}

TEST_F(TwoObjects, WhatNoLongerFitsGoes) {
  trace(2);
  std::filesystem::remove(folder_.path() / "wall.exr");
  trace(1);
  EXPECT_EQ(keys(), floor_) << "without its file";
  trace(2);
  Mesh& mesh = exported_.diffuse_scene.survey
                   .meshes[static_cast<std::size_t>(exported_.diffuse_scene.survey.objects[1].mesh)];
  std::swap(mesh.loop_vertex[0], mesh.loop_vertex[1]);
  trace(1);
  EXPECT_EQ(keys(), floor_) << "with other faces";
  trace(2);
  mesh.uv_layers.front().uv.front().x += 1e-3F;
  trace(1);
  EXPECT_EQ(keys(), floor_) << "with other UVs";
  trace(2);
  exported_.diffuse_scene.survey.objects[1].key = "fence";
  exported_.list.targets[1].key = "fence";
  trace(1);
  EXPECT_EQ(keys(), floor_) << "without its object";
}

TEST_F(TwoObjects, MovedVerticesKeepIt) {
  trace(2);
  exported_.diffuse_scene.survey.meshes.back().positions[0].z += 0.5F;
  trace(1);
  EXPECT_EQ(keys(), both_);
}

TEST_F(TwoObjects, AnotherKindIsRefusedBeforeAnythingIsWritten) {
  trace(2);
  config_.globals.output.normalize = Normalize::flat;
  expect_refusal("normalisation");
  trace(2);  // replaces all: nothing to refuse
  config_.globals.scene.file = "other.blend";
  expect_refusal("scene");
  config_.globals.scene.file = "scene.blend";
  kind_ = "bake";
  expect_refusal("kind");
  kind_ = "reference";
  bases_.pop_back();
  expect_refusal("flat,rnm0,rnm1,rnm2");
}

TEST_F(TwoObjects, WhatIsNoManifestIsReplaced) {
  write_atomically(folder_.path() / "manifest.json", "{\"objects\": 3}");
  trace(1);
  EXPECT_EQ(keys(), floor_);
}

TEST_F(TwoObjects, AnEarlierNameIsNotGivenToAnotherFile) {
  exported_.list.targets[1].key = exported_.diffuse_scene.survey.objects[1].key = "FLOOR";
  std::swap(exported_.list.targets[0], exported_.list.targets[1]);
  trace(1);  // FLOOR.exr
  std::swap(exported_.list.targets[0], exported_.list.targets[1]);
  trace(1);
  const auto objects = manifest().at("objects");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects.at(1).at("files").at(0), "FLOOR.exr");
  EXPECT_NE(objects.at(0).at("files").at(0), "floor.exr");
}

}  // namespace
}  // namespace rnmbake
