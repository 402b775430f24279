#include "with_blender/survey_session.h"

#include <fstream>
#include <memory>
#include <string>
#include <variant>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// The scenes of scenes/refusal_cases.py: each is refused in words that name the culprit.
class RefusalsWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    session_ = std::make_unique<SurveySession>();
    session_->build("refusal_cases.py", {session_->file("").string()});
    std::ofstream(session_->file("broken.glb")) << "no glTF";
  }
  static void TearDownTestSuite() { session_.reset(); }

  static std::string refusal(const std::string& name) {
    const LaunchOutcome outcome = session_->launch(session_->file(name));
    const auto* failure = std::get_if<LaunchFailure>(&outcome);
    if (failure == nullptr) return "it was surveyed";
    EXPECT_EQ(failure->kind, LaunchFailure::Kind::refused) << failure->message << failure->details;
    EXPECT_EQ(failure->message.find('\n'), std::string::npos) << failure->message;
    return failure->message;
  }

  static std::unique_ptr<SurveySession> session_;
};

std::unique_ptr<SurveySession> RefusalsWithBlender::session_;

TEST_F(RefusalsWithBlender, NameTheObjectOfABlockedDriver) {
  EXPECT_NE(refusal("driver.blend").find("'driven'"), std::string::npos);
}

TEST_F(RefusalsWithBlender, NameABlockedScript) {
  const std::string message = refusal("autorun.blend");
  EXPECT_NE(message.find("auto.py"), std::string::npos) << message;
  EXPECT_NE(message.find("--allow-scripts"), std::string::npos) << message;
}

TEST_F(RefusalsWithBlender, NameAMissingLibrary) {
  EXPECT_NE(refusal("lost_library.blend").find("library.blend"), std::string::npos);
}

TEST_F(RefusalsWithBlender, NameAnObjectThatIsNowhere) {
  EXPECT_NE(refusal("nan_place.blend").find("'nan_place'"), std::string::npos);
}

TEST_F(RefusalsWithBlender, NameABrokenGltf) {
  EXPECT_NE(refusal("broken.glb").find("broken.glb"), std::string::npos);
}

TEST_F(RefusalsWithBlender, NameAVertexThatIsNowhere) {
  try {
    (void)session_->survey(session_->file("nan_vertex.blend"));
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("object 'nan_vertex': vertex 3"), std::string::npos)
        << error.what();
  }
}

TEST_F(RefusalsWithBlender, NameWhatIsDisplacedAsItRendersAndIsNoMesh) {
  const std::string message = refusal("displaced.blend");
  for (const char* words : {"'relief'", "'rough rock'", "Displace modifier", "Bump Only"})
    EXPECT_NE(message.find(words), std::string::npos) << message;
  const LaunchOutcome lambert = session_->launch(session_->file("displaced.blend"), "lambert_entry.py");
  ASSERT_NE(std::get_if<LaunchFailure>(&lambert), nullptr);
  EXPECT_EQ(std::get<LaunchFailure>(lambert).message, message);
}

TEST_F(RefusalsWithBlender, NameAShaderProgram) {
  const std::string message = refusal("program.blend");
  EXPECT_NE(message.find("'pattern'"), std::string::npos) << message;
  EXPECT_NE(message.find("--allow-scripts"), std::string::npos) << message;
}

TEST_F(RefusalsWithBlender, AreNotMadeForFilesThatCannotBeHad) {
  const SceneSurvey survey = session_->survey(session_->file("lost_files.blend"));
  ASSERT_EQ(survey.warnings.size(), 3U);
  EXPECT_TRUE(survey.warnings[0].starts_with("picture missing: ")) << survey.warnings[0];
  EXPECT_NE(survey.warnings[0].find("lost.png"), std::string::npos);
  EXPECT_TRUE(survey.warnings[1].starts_with("picture unreadable: 'text.png' (")) << survey.warnings[1];
  EXPECT_NE(survey.warnings[2].find("object 'cube': the cache of its modifier 'cache' is missing"),
            std::string::npos);
}

}  // namespace
}  // namespace rnmbake
