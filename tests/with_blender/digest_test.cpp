// The scene digest and the files that a scene reads: scenes/digest_check.py has the tables of changes.
#include "scene/scene_digest.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class SceneDigestWithBlender : public testing::Test {
 protected:
  /// Throws what the script says where a change is not named rightly.
  static void SetUpTestSuite() {
    session_ = std::make_unique<SurveySession>();
    session_->build("digest_check.py", {session_->file("digest").string()});
  }
  static void TearDownTestSuite() { session_.reset(); }

  static fs::path file(const std::string& name) { return session_->file("digest") / name; }
  static SceneSurvey survey(const std::string& name) { return session_->survey(file(name)); }

  /// "kind name" of each input, in the order of their names.
  static Names inputs(const std::vector<InputFile>& files) {
    Names names;
    for (const InputFile& input : files) {
      EXPECT_TRUE(input.path.is_absolute()) << input.path;
      EXPECT_EQ(input.was_there, fs::exists(input.path)) << input.path;
      names.push_back(input.kind + " " + input.path.filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  static std::unique_ptr<SurveySession> session_;
};

std::unique_ptr<SurveySession> SceneDigestWithBlender::session_;

TEST_F(SceneDigestWithBlender, IsTheSameForEveryLaunchAndPlace) {
  const SceneSurvey first = survey("scene.blend");
  EXPECT_GT(first.digest.entries.size(), 30U);
  EXPECT_EQ(differences(first.digest, survey("scene.blend").digest), Names{});
  const SceneSurvey moved = session_->survey(session_->file("digest_moved") / "other name.blend");
  EXPECT_EQ(differences(first.digest, moved.digest), Names{});
  EXPECT_EQ(first.digest.hash(), moved.digest.hash());
}

TEST_F(SceneDigestWithBlender, ComesWithTheFilesThatTheSceneReads) {
  EXPECT_EQ(inputs(survey("scene.blend").inputs),
            (Names{"library furniture.blend", "picture film_0001.png", "picture tiles.1001.png",
                   "picture tiles.1002.png", "picture wall.png"}));
}

TEST_F(SceneDigestWithBlender, IsTheSameForEveryImport) {
  for (const std::string ending : {"gltf", "obj"}) {
    const SceneSurvey first = survey("room." + ending);
    EXPECT_EQ(differences(first.digest, survey("room." + ending).digest), Names{});
    EXPECT_TRUE(std::ranges::any_of(first.digest.entries, [](const DigestEntry& entry) {
      return entry.what.starts_with("picture 'wall");
    })) << ending;
  }
}

TEST_F(SceneDigestWithBlender, KnowsTheFilesOfImports) {
  const auto imported = [](const std::string& name) {
    const LaunchOutcome outcome = session_->import_only(file(name));
    return inputs(read_inputs(std::get<Finished>(outcome).result.at("inputs")));
  };
  EXPECT_EQ(imported("room.gltf"), (Names{"buffer room.bin", "picture wall.png"}));
  EXPECT_EQ(imported("room.obj"), (Names{"material library room.mtl", "picture wall.png"}));
}

}  // namespace
}  // namespace rnmbake
