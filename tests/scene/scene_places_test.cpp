#include "scene/scene_places.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Names = std::vector<std::string>;

/// A room of two boxes 10 units apart with a picture each that they share with nobody, a lamp and a world.
class Places : public testing::Test {
 protected:
  Places() {
    Mesh mesh;
    mesh.positions = {Vec3(-0.5F, -0.5F, -0.5F), Vec3(0.5F, 0.5F, 0.5F)};
    survey_.meshes = {mesh};
    for (const char* name : {"left", "right"}) {
      SceneObject object;
      object.key = object.name = name;
      object.mesh = 0;
      survey_.objects.push_back(object);
    }
    survey_.objects[1].to_world.translate(Vec3d(10, 0, 0));
    LightInfo lamp;
    lamp.name = "lamp";
    lamp.type = "POINT";
    lamp.energy = 0.1;
    lamp.to_world.translate(Vec3d(0, 0, 3));
    survey_.lights = {lamp};
    survey_.digest.entries = {{"light 'bulb'", "1"},
                              {"material 'brick'", "1", {"picture 'brick.png'"}},
                              {"mesh 'cube'", "1"},
                              {"object 'lamp'", "1", {"light 'bulb'"}},
                              {"object 'left'", "1", {"material 'brick'", "mesh 'cube'"}},
                              {"object 'right'", "1", {"mesh 'cube'"}},
                              {"picture 'brick.png'", "1"},
                              {"picture 'sky.hdr'", "1"},
                              {"scene settings", "1"},
                              {"world 'World'", "1", {"picture 'sky.hdr'"}}};
    before_ = place_scene(survey_);
  }

  void change(const std::string& part) {
    for (DigestEntry& entry : survey_.digest.entries) {
      if (entry.what == part) entry.hash = "2";
    }
  }
  [[nodiscard]] PlacedChanges changes() const { return placed_changes(before_, place_scene(survey_)); }
  /// Of the objects of the scene as it is now, those that are within `distance` of a change.
  [[nodiscard]] Names concerned(double distance) const {
    const PlacedChanges found = changes();
    Names keys;
    for (const PlacedObject& object : place_scene(survey_).objects) {
      if (found.reach(object.box, distance)) keys.push_back(object.key);
    }
    return keys;
  }

  SceneSurvey survey_;
  PlacedScene before_;
};

TEST_F(Places, AreTheSameWhereNothingChanged) {
  EXPECT_TRUE(changes().empty());
  EXPECT_EQ(concerned(1e6), Names{});
}

TEST_F(Places, APictureConcernsTheObjectThatShowsIt) {
  change("picture 'brick.png'");
  EXPECT_EQ(concerned(0), Names{"left"});
  EXPECT_EQ(concerned(8.99), Names{"left"});
  EXPECT_EQ(concerned(9.01), (Names{"left", "right"}));  // from side to side
}

TEST_F(Places, AMeshConcernsAllThatHaveIt) {
  change("mesh 'cube'");
  EXPECT_EQ(concerned(0), (Names{"left", "right"}));
}

TEST_F(Places, WhatMovedConcernsWhereItWasAndWhereItIs) {
  survey_.objects[0].to_world.translate(Vec3d(0, 50, 0));
  change("object 'left'");
  EXPECT_EQ(changes().boxes.size(), 2U);
  EXPECT_EQ(concerned(9.01), (Names{"left", "right"}));
  EXPECT_EQ(concerned(8.99), Names{"left"});
}

TEST_F(Places, WhatIsGoneConcernsItsSurroundings) {
  survey_.objects.erase(survey_.objects.begin());
  std::erase_if(survey_.digest.entries, [](const DigestEntry& entry) {
    return entry.what == "object 'left'" || entry.what.find("brick") != std::string::npos;
  });
  EXPECT_EQ(concerned(8.99), Names{});
  EXPECT_EQ(concerned(9.01), Names{"right"});
  EXPECT_TRUE(changes().everywhere.empty());
}

TEST_F(Places, ALampConcernsWhatItReaches) {
  // 0.1 W: 0.1 / (4 pi) W/sr; E/pi falls to 1/256 where r^2 = 256 x 0.1 / (4 pi^2).
  EXPECT_NEAR(before_.lamps.at(0).reach, std::sqrt(256 * 0.1 / (4 * pi * pi)), 1e-12);
  change("light 'bulb'");
  EXPECT_EQ(concerned(0), Names{}) << "2.5 above the left one, 0.8 of reach";
  EXPECT_EQ(concerned(2.6), Names{"left"});
  survey_.lights[0].energy = 1;
  EXPECT_EQ(concerned(0), Names{"left"}) << "as bright as it is now";
  survey_.lights[0].energy = 100;
  EXPECT_EQ(concerned(0), (Names{"left", "right"}));
}

TEST_F(Places, ALampWithoutEndConcernsAll) {
  survey_.lights[0].type = "SUN";
  change("light 'bulb'");
  EXPECT_EQ(changes().everywhere, Names{"object 'lamp'"});
  EXPECT_EQ(concerned(0), (Names{"left", "right"}));
}

TEST_F(Places, ALampThatAnInstancerMovesIsSeen) {
  survey_.lights[0].to_world.translate(Vec3d(1, 0, 0));
  EXPECT_EQ(changes().lamps.size(), 2U);
}

TEST_F(Places, WhatBelongsToNoObjectConcernsAll) {
  for (const char* part : {"world 'World'", "scene settings", "picture 'sky.hdr'"}) {
    change(part);
    EXPECT_EQ(concerned(0), (Names{"left", "right"})) << part;
    before_ = place_scene(survey_);
  }
}

TEST_F(Places, APictureOfObjectAndSkyConcernsAll) {
  survey_.digest.entries.back().uses = {"picture 'brick.png'", "picture 'sky.hdr'"};
  before_ = place_scene(survey_);
  change("picture 'brick.png'");
  EXPECT_EQ(concerned(0), (Names{"left", "right"}));
}

TEST_F(Places, InstancesMoveTogether) {
  survey_.objects[1].instancer = "scatter";
  survey_.digest.entries.push_back({"instances of 'scatter'", "1", {"object 'right'"}});
  before_ = place_scene(survey_);
  change("instances of 'scatter'");
  EXPECT_EQ(concerned(0), Names{"right"});
}

TEST_F(Places, ComeBackFromAFile) {
  const PlacedScene back = placed_scene_from(nlohmann::json::parse(to_json(before_).dump()));
  EXPECT_TRUE(placed_changes(before_, back).empty());
  EXPECT_EQ(back.digest.entries, before_.digest.entries);
  change("picture 'brick.png'");
  EXPECT_EQ(placed_changes(back, place_scene(survey_)).boxes.size(), 2U);
  EXPECT_THROW((void)placed_scene_from(nlohmann::json::array({1, 2})), nlohmann::json::exception);
}

}  // namespace
}  // namespace rnmbake
