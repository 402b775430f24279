// What a saved scene says about its pictures must not reach the light that is measured:
// scenes/state_cases.py.
#include "base/files.h"
#include "image/layered_exr.h"
#include "process/run.h"
#include "with_blender/survey_session.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

class SceneStateWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    session_ = std::make_unique<SurveySession>();
    session_->build("state_cases.py", {session_->file("").string()});
  }
  static void TearDownTestSuite() { session_.reset(); }

  /// The lightmap of the object "Plane", and what was said.
  static LayeredImage bake(const std::string& name, std::string& said) {
    const fs::path folder = session_->file(name);
    ProcessOptions options;
    options.argv = {RNMBAKE_BINARY, "bake", session_->file(name + ".blend").string(), "-o", folder.string()};
    for (const char* word : {"--objects", "Plane", "--resolution", "8", "--samples", "16", "--bases",
                             "flat,rnm0", "--save-scene", "never", "--dilate", "0", "--depth", "float"}) {
      options.argv.emplace_back(word);
    }
    const ProcessResult result = run_process(options);
    if (!result.succeeded()) fail(ExitCode::tasks_failed, "{}", result.output);
    said = result.output;
    return read_image(folder / "Plane.exr");
  }

  static std::unique_ptr<SurveySession> session_;
};

std::unique_ptr<SurveySession> SceneStateWithBlender::session_;

TEST_F(SceneStateWithBlender, OfPicturesLeavesEveryTexelAsItWas) {
  std::string said;
  const LayeredImage clean = bake("clean", said);
  const LayeredImage hostile = bake("hostile", said);
  ASSERT_EQ(clean.layers.size(), hostile.layers.size());
  for (std::size_t i = 0; i < clean.layers.size(); ++i) {
    const FloatImage &a = clean.layers[i].pixels, &b = hostile.layers[i].pixels;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        for (std::size_t c = 0; c < a.texel(x, y).size(); ++c)
          ASSERT_EQ(a.texel(x, y)[c], b.texel(x, y)[c]) << clean.layers[i].name << " at " << x << "," << y;
      }
    }
  }
  EXPECT_NE(said.find("object 'Cube.001': adaptive subdivision is left out"), std::string::npos) << said;
  EXPECT_NE(said.find("view layer 'ViewLayer' shows no surfaces"), std::string::npos) << said;
}

TEST_F(SceneStateWithBlender, OverridesAreTheScenesAndNotTheReceivers) {
  std::string said;
  const LayeredImage lightmap = bake("overridden", said);
  const double expected = std::cos(75 * M_PI / 180);
  const FloatImage& flat = lightmap.find("")->pixels;
  EXPECT_NEAR(flat.texel(4, 4)[1], expected, 1e-4 * expected);
  EXPECT_NE(said.find("overrides all materials with 'clay'"), std::string::npos) << said;
}

/// A receiver that stayed below the raised surface would see half of the sky at most.
TEST_F(SceneStateWithBlender, TrueDisplacementMovesReceiversToo) {
  std::string said;
  const LayeredImage lightmap = bake("displaced", said);
  const FloatImage &flat = lightmap.find("")->pixels, &coverage = lightmap.find("coverage")->pixels;
  int covered = 0;
  for (int y = 0; y < flat.height(); ++y) {
    for (int x = 0; x < flat.width(); ++x) {
      if (coverage.texel(x, y)[0] < 0.5F) continue;
      ++covered;
      EXPECT_NEAR(flat.texel(x, y)[1], 1, 1e-5) << x << "," << y;
    }
  }
  EXPECT_GT(covered, 8);
  EXPECT_NE(said.find("object 'Plane': material 'raised' displaces it as it renders"), std::string::npos)
      << said;
  const SceneSurvey survey = session_->survey(session_->file("displaced.blend"));
  for (const Vec3& position : survey.meshes.at(0).positions) EXPECT_NEAR(position.z, 0.1, 1e-6);
  EXPECT_EQ(survey.meshes.at(0).triangles(), 4U);
}

}  // namespace
}  // namespace rnmbake
