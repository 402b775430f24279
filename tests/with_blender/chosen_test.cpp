// --scene, --view-layer and --frame through every launch: scenes/chosen_case.py.
#include "base/files.h"
#include "base/read_file.h"
#include "image/layered_exr.h"
#include "support/pictures.h"
#include "support/run_words.h"
#include "with_blender/survey_session.h"

#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

class ChosenWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    session_ = std::make_unique<SurveySession>();
    session_->build("chosen_case.py", {path("two.blend")});
  }
  static void TearDownTestSuite() { session_.reset(); }

  static std::string path(const std::string& name) { return session_->file(name).string(); }

  static ProcessResult rnmbake(const std::string& command, const Words& flags) {
    Words words{RNMBAKE_BINARY, "-q", command, path("two.blend"), "--blender", find_blender().string()};
    words.insert(words.end(), flags.begin(), flags.end());
    return run_words(words);
  }

  static Words objects(const Words& flags) {
    Words words{"--json"};
    words.insert(words.end(), flags.begin(), flags.end());
    const ProcessResult result = rnmbake("inspect", words);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    Words keys;
    const json told = json::parse(result.output);
    for (const json& object : told.at("objects")) keys.push_back(object.at("key").get<std::string>());
    std::ranges::sort(keys);
    return keys;
  }

  /// Mean of a floor's lightmap; the folder holds no other.
  static double light(const std::string& command, Words flags) {
    const std::string out = path("out");
    std::filesystem::remove_all(out);
    for (const char* word : {"--resolution", "4", "--samples", "4", "--bases", "flat", "--depth", "float"})
      flags.emplace_back(word);
    flags.insert(flags.end(), {"-o", out});
    const ProcessResult result = rnmbake(command, flags);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    const json manifest = json::parse(read_text(out + "/manifest.json"));
    EXPECT_EQ(manifest.at("objects").size(), 1U);
    const LayeredImage map =
        read_image(out + "/" + manifest.at("objects")[0].at("files")[0].get<std::string>());
    return covered_means(map.find("")->pixels, map.find("coverage")->pixels).value[0];
  }

  static void expect_refused(const Words& flags, const std::string& says) {
    const ProcessResult result = rnmbake("inspect", flags);
    EXPECT_EQ(result.exit_code, static_cast<int>(ExitCode::usage)) << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << result.output;
  }

  static std::unique_ptr<SurveySession> session_;
};

std::unique_ptr<SurveySession> ChosenWithBlender::session_;

TEST_F(ChosenWithBlender, ShowsTheSceneAndTheLayerThatWereAskedFor) {
  EXPECT_EQ(objects({}), Words{"a"});
  EXPECT_EQ(objects({"--scene", "Second"}), (Words{"b", "c"}));
  EXPECT_EQ(objects({"--scene", "Second", "--view-layer", "Less"}), Words{"b"});
}

TEST_F(ChosenWithBlender, NamesWhatThereIsInstead) {
  expect_refused({"--scene", "Third"}, "no scene 'Third' in it; there is 'First' and 'Second'");
  expect_refused({"--scene", "Second", "--view-layer", "Third"},
                 "no view layer 'Third' in it; there is 'All' and 'Less'");
}

/// The sun's strength is the frame's number; a floor under it holds that over pi.
TEST_F(ChosenWithBlender, HasTheLightOfTheFrame) {
  const Words second{"--scene", "Second", "--view-layer", "Less"};
  const auto at = [&](const char* frame, Words more = {}) {
    Words flags{"--frame", frame};
    flags.insert(flags.end(), second.begin(), second.end());
    flags.insert(flags.end(), more.begin(), more.end());
    return flags;
  };
  const double exact = 1e-5;  // of the value: roundings of floats
  const auto over_pi = [](double strength) { return strength / std::numbers::pi; };
  EXPECT_NEAR(light("bake", second), over_pi(1), exact * over_pi(1));  // the file's own frame
  EXPECT_NEAR(light("bake", at("51")), over_pi(51), exact * over_pi(51));
  EXPECT_NEAR(light("bake", at("7", {"--materials", "lambert", "--save-scene", "always"})), over_pi(7),
              exact * over_pi(7));
  EXPECT_NEAR(light("reference", at("7")), over_pi(7), exact * over_pi(7));
}

TEST_F(ChosenWithBlender, HasNoChoiceInAnExportedScene) {
  const std::string exported = path("second.rnmscene");
  const ProcessResult wrote = rnmbake("export", {"--scene", "Second", "--frame", "9", "-o", exported});
  ASSERT_EQ(wrote.exit_code, 0) << wrote.output;
  const ProcessResult refused =
      run_words({RNMBAKE_BINARY, "reference", exported, "-o", path("none"), "--frame", "3"});
  EXPECT_EQ(refused.exit_code, static_cast<int>(ExitCode::usage)) << refused.output;
  EXPECT_NE(refused.output.find("--frame is for a .blend"), std::string::npos) << refused.output;
}

}  // namespace
}  // namespace rnmbake
