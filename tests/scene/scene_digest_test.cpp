#include "scene/scene_digest.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Sentences = std::vector<std::string>;

const SceneDigest room{{{"material 'Brick'", "1"}, {"object 'Wall'", "2"}, {"picture 'wall.png'", "3"}}};

TEST(SceneDigestDifferences, AreNoneBetweenEqualScenes) {
  EXPECT_EQ(differences(room, room), Sentences{});
  EXPECT_EQ(differences({}, {}), Sentences{});
}

TEST(SceneDigestDifferences, NameWhatChangedCameAndWent) {
  SceneDigest after = room;
  after.entries = {{"object 'Lamp'", "9"}, {"object 'Wall'", "2"}, {"picture 'wall.png'", "4"}};
  EXPECT_EQ(differences(room, after),
            (Sentences{"material 'Brick' is gone", "object 'Lamp' is new", "picture 'wall.png' changed"}));
}

TEST(SceneDigestDifferences, ReachBothEnds) {
  const SceneDigest one{{{"object 'M'", "1"}}};
  const SceneDigest more{{{"object 'A'", "1"}, {"object 'M'", "1"}, {"object 'Z'", "1"}}};
  EXPECT_EQ(differences(one, more), (Sentences{"object 'A' is new", "object 'Z' is new"}));
  EXPECT_EQ(differences(more, one), (Sentences{"object 'A' is gone", "object 'Z' is gone"}));
  EXPECT_EQ(differences({}, one), Sentences{"object 'M' is new"});
}

TEST(SceneDigestHash, DependsOnEveryNameAndHash) {
  const std::string hash = room.hash();
  EXPECT_EQ(hash.size(), 32U);
  EXPECT_EQ(SceneDigest(room).hash(), hash);
  for (std::size_t i = 0; i < room.entries.size(); ++i) {
    SceneDigest other = room;
    other.entries[i].hash += "0";
    EXPECT_NE(other.hash(), hash) << i;
    other = room;
    other.entries[i].what += "x";
    EXPECT_NE(other.hash(), hash) << i;
    other = room;
    other.entries.erase(other.entries.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_NE(other.hash(), hash) << i;
  }
}

TEST(SceneDigestHash, TellsNamesFromHashes) {
  EXPECT_NE((SceneDigest{{{"a", "bc"}}}).hash(), (SceneDigest{{{"ab", "c"}}}).hash());
  EXPECT_NE((SceneDigest{{{"a", "1"}, {"b", "2"}}}).hash(), (SceneDigest{{{"a", "11:b1:2"}}}).hash());
}

TEST(InputFiles, AreListedOnce) {
  std::vector<InputFile> files{{"scene", "/a.blend", true}};
  add_inputs(files,
             {{"picture", "/b.png", false}, {"library", "/a.blend", true}, {"picture", "/b.png", true}});
  EXPECT_EQ(files, (std::vector<InputFile>{{"scene", "/a.blend", true}, {"picture", "/b.png", false}}));
}

}  // namespace
}  // namespace rnmbake
