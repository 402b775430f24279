// Lights that choose what they light (Blender 4.0 and later) choose among receivers as among their originals.
#include "base/files.h"
#include "image/layered_exr.h"
#include "process/run.h"
#include "survey_session.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

class LightLinkingWithBlender : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(LightLinkingWithBlender, ASunLightsWhatItIsLinkedToOnly) {
  SurveySession session;
  if (session.info().version < BlenderVersion{4, 0, 0}) {
    GTEST_SKIP() << "SKIPPED: Blender " << session.info().version_text << " has no light linking";
  }
  const fs::path scene = session.file("linked.blend");
  session.build("light_linking_case.py", {scene.string()});
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY,
                  "bake",
                  scene.string(),
                  "-o",
                  session.file("out").string(),
                  "--bases",
                  "flat",
                  "--samples",
                  "4",
                  "--resolution",
                  "8",
                  "--bounces",
                  "0",
                  "--depth",
                  "float"};
  options.argv.insert(options.argv.end(), GetParam().begin(), GetParam().end());
  const ProcessResult result = run_process(options);
  ASSERT_TRUE(result.succeeded()) << result.output;
  const auto brightness = [&](const std::string& name) {
    return read_image(session.file("out") / (name + ".exr")).find("")->pixels.texel(4, 4)[0];
  };
  EXPECT_NEAR(brightness("chosen"), 2, 1e-3);
  EXPECT_NEAR(brightness("other"), 1, 1e-3);
  EXPECT_NEAR(brightness("row_placed#0-0f42ef92"), 2, 1e-3);  // its instancer is the one that the sun names
}

INSTANTIATE_TEST_SUITE_P(
    Recipes, LightLinkingWithBlender,
    testing::Values(std::vector<std::string>{"--recipe", "receiver"},
                    std::vector<std::string>{"--recipe", "receiver", "--materials", "lambert"},
                    std::vector<std::string>{"--recipe", "flat-normal-map"},
                    std::vector<std::string>{"--recipe", "flat-normal-map", "--unwrap", "always"}));

}  // namespace
}  // namespace rnmbake
