#include "pipeline/lightmaps/left_files.h"

#include "base/files.h"
#include "base/hash.h"
#include "pipeline/lightmaps/manifest_file.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

/// A folder with lightmaps of a door and a wall, and a manifest of them.
class LeftFiles : public testing::Test {
 protected:
  LeftFiles() {
    for (const char* name : {"door", "wall"}) {
      SceneObject object;
      object.key = name;
      survey_.objects.push_back(object);
    }
    before_ = manifest({baked("door", "", "door.exr"), baked("wall", "", "wall.exr")});
    write_atomically(folder_.path() / "manifest.json", before_.dump());
  }

  json baked(const std::string& key, const std::string& part, const std::string& file) {
    write_atomically(folder_.path() / file, "pixels of " + file);
    return {{"key", key},
            {"part", part},
            {"status", "baked"},
            {"files", {file}},
            {"hashes", {hash128_hex("pixels of " + file)}}};
  }
  static json failed(const std::string& key) {
    return {{"key", key}, {"part", ""}, {"status", "failed"}, {"files", json::array()}};
  }
  static json manifest(const json& objects) {
    return {{"schema_version", manifest_schema_version}, {"objects", objects}};
  }
  /// Replaces the manifest.
  void bake(const json& objects) {
    const json now = manifest(objects);
    write_atomically(folder_.path() / "manifest.json", now.dump());
    note_left_files(folder_.path(), before_, now, survey_);
    before_ = now;
  }
  Pruned prune() { return prune_left_files(folder_.path()); }
  [[nodiscard]] bool is_there(const char* name) const {
    return std::filesystem::exists(folder_.path() / name);
  }

  TempFolder folder_;
  SceneSurvey survey_;
  json before_;
};

TEST_F(LeftFiles, GoWithTheirObjectAlone) {
  survey_.objects.erase(survey_.objects.begin());
  bake(json::array({before_["objects"][1]}));
  EXPECT_TRUE(is_there("door.exr"));
  EXPECT_EQ(prune().removed, Names{"door.exr"});
  EXPECT_FALSE(is_there("door.exr"));
  EXPECT_TRUE(is_there("wall.exr"));
  EXPECT_EQ(prune().removed, Names{});
}

TEST_F(LeftFiles, AreKnownAfterLaterBakes) {
  survey_.objects.erase(survey_.objects.begin());
  bake(json::array({before_["objects"][1]}));
  bake(json::array({baked("wall", "", "wall.exr")}));
  EXPECT_EQ(prune().removed, Names{"door.exr"});
}

TEST_F(LeftFiles, StayWhereTheyWereChanged) {
  survey_.objects.erase(survey_.objects.begin());
  bake(json::array({before_["objects"][1]}));
  write_atomically(folder_.path() / "door.exr", "painted over");
  for (int again = 0; again < 2; ++again) {
    const Pruned pruned = prune();
    EXPECT_EQ(pruned.removed, Names{});
    EXPECT_EQ(pruned.changed, Names{"door.exr"});
  }
  EXPECT_TRUE(is_there("door.exr"));
}

TEST_F(LeftFiles, AreThoseOfAnotherSplitOrLayout) {
  bake({baked("door/oak", "oak", "door_oak.exr"), baked("wall", "", "wall.flat.exr")});
  EXPECT_EQ(prune().removed, (Names{"door.exr", "wall.exr"}));
  EXPECT_TRUE(is_there("door_oak.exr") && is_there("wall.flat.exr"));
}

TEST_F(LeftFiles, AreNoneOfObjectsThatFailedOrWereNotBaked) {
  bake(json::array({failed("door")}));  // and the wall was left out: its UVs are others
  EXPECT_EQ(prune().removed, Names{});
  EXPECT_TRUE(is_there("door.exr") && is_there("wall.exr"));
}

TEST_F(LeftFiles, AreNoneThatAManifestListsAgain) {
  survey_.objects.erase(survey_.objects.begin());
  const json door = before_["objects"][0];
  bake(json::array({before_["objects"][1]}));
  write_atomically(folder_.path() / "manifest.json", manifest({door, before_["objects"][0]}).dump());
  EXPECT_EQ(prune().removed, Names{});
  EXPECT_TRUE(is_there("door.exr"));
}

TEST_F(LeftFiles, AreNoneOutsideOfTheFolder) {
  const TempFolder elsewhere;
  const std::filesystem::path file = elsewhere.path() / "door.exr";
  write_atomically(file, "pixels");
  json door = before_["objects"][0];
  door["files"] = {"../" + elsewhere.path().filename().string() + "/door.exr"};
  door["hashes"] = {hash128_hex("pixels")};
  std::filesystem::create_symlink(file, folder_.path() / "link.exr");
  json link = door;
  link["files"] = {"link.exr"};
  before_ = manifest({door, link});
  survey_.objects.clear();
  bake(json::array());
  EXPECT_EQ(prune().removed, Names{});
  EXPECT_TRUE(std::filesystem::exists(file) && is_there("link.exr"));
}

}  // namespace
}  // namespace rnmbake
