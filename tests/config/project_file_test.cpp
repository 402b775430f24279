#include "config/project_file.h"

#include "base/error.h"

#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::string refusal(const std::string& text) {
  try {
    (void)parse_project(text, "some/project.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "accepted";
}

SettingValue value(const ProjectFile& project, std::string_view key) {
  for (const SettingOverride& given : project.values) {
    if (given.setting->key == key) return given.value;
  }
  throw std::logic_error("not given");
}

TEST(ProjectFile, ReadsEveryKind) {
  const ProjectFile project = parse_project(R"([scene]
objects = ["a", "b*"]
exclude = "sky"
[bake]
samples = 12
texels_per_unit = 3
clamp = 2.5
uv = "Lightmap"
device = "cuda"
flip_green = true
)",
                                            "project.toml");
  using List = std::vector<std::string>;
  EXPECT_EQ(value(project, "objects"), SettingValue(List{"a", "b*"}));
  EXPECT_EQ(value(project, "exclude"), SettingValue(List{"sky"}));
  EXPECT_EQ(value(project, "samples"), SettingValue(std::int64_t{12}));
  EXPECT_EQ(value(project, "texels_per_unit"), SettingValue(3.0));
  EXPECT_EQ(value(project, "clamp"), SettingValue(2.5));
  EXPECT_EQ(value(project, "uv"), SettingValue(std::string("Lightmap")));
  EXPECT_EQ(value(project, "device"), SettingValue(std::string("CUDA")));
  EXPECT_EQ(value(project, "flip_green"), SettingValue(true));
}

TEST(ProjectFile, KeysOfManyPartsAreRefusedBeforeTheyAreNested) {
  std::string deep = "a";
  for (int i = 0; i < 100000; ++i) deep += ".a";
  for (const std::string& text :
       {"\n" + deep + " = 1\n", "\n[" + deep + "]\n", "\n[[" + deep + "]]\n", "\na = {" + deep + " = 1}\n",
        "\n'x'.\"=\"." + deep + " = 1\n", "#\n" + deep + " = 1\n"}) {
    const std::string said = refusal(text);
    EXPECT_EQ(said.rfind("some/project.toml:2: a key of more than", 0), 0U) << said.substr(0, 200);
  }
  EXPECT_NE(refusal("a = " + std::string(100000, '[')).find("not TOML"), std::string::npos);
  const std::string dots(20, '.');
  EXPECT_EQ(refusal("[scene] # " + dots + "\nfile = '" + dots + "'\nobjects = [\"" + dots + "\\\"" + dots +
                    "\", '''" + dots + "''''']\n"),
            "accepted");
}

TEST(ProjectFile, ValuesKnowTheirLine) {
  const ProjectFile project = parse_project("[bake]\n\nsamples = 3\n", "dir/project.toml");
  ASSERT_EQ(project.values.size(), 1U);
  EXPECT_EQ(project.values[0].where, "dir/project.toml:3");
}

TEST(ProjectFile, PathsStartFromItsFolder) {
  const ProjectFile project = parse_project(R"([scene]
file = "../hall.blend"
[output]
dir = "/abs/out"
[run]
blender = "blender-4.3"
)",
                                            "projects/hall/project.toml");
  EXPECT_EQ(value(project, "file"), SettingValue(std::string("projects/hall.blend")));
  EXPECT_EQ(value(project, "dir"), SettingValue(std::string("/abs/out")));
  EXPECT_EQ(value(project, "blender"), SettingValue(std::string("blender-4.3")));  // looked up in PATH
  const ProjectFile with_slash = parse_project("[run]\nblender = \"./blender\"\n", "p/project.toml");
  EXPECT_EQ(value(with_slash, "blender"), SettingValue(std::string("p/blender")));
}

TEST(ProjectFile, OverridesKeepTheirOrder) {
  const ProjectFile project = parse_project(R"([[override]]
objects = "floor*"
samples = 512
dilate = 8

[[override]]
objects = ["a", "b"]
uv = "UV2"
)",
                                            "project.toml");
  ASSERT_EQ(project.overrides.size(), 2U);
  EXPECT_EQ(project.overrides[0].objects, std::vector<std::string>{"floor*"});
  EXPECT_EQ(project.overrides[0].values.size(), 2U);
  EXPECT_EQ(project.overrides[0].where, "project.toml:1");
  EXPECT_EQ(project.overrides[1].objects, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(project.overrides[1].values.at(0).where, "project.toml:8");
}

TEST(ProjectFile, EachOfSeveralScenesHasWhatHoldsForAllAndItsOwn) {
  const ProjectFile project = parse_project(R"([scene]
exclude = "proxy_*"
[bake]
samples = 64
texels_per_unit = 8
[[override]]
objects = "floor*"
samples = 128
[[scenes]]
file = "hall.blend"
[[scenes]]
file = "../yard.blend"
dir = "yard-maps"
resolution = 32
[[scenes.override]]
objects = "gate"
samples = 256
)",
                                            "game/project.toml");
  ASSERT_EQ(project.scenes.size(), 2U);
  const ProjectFile hall = project.of_scene(project.scenes[0]), yard = project.of_scene(project.scenes[1]);
  EXPECT_EQ(value(hall, "file"), SettingValue(std::string("game/hall.blend")));
  EXPECT_EQ(value(hall, "texels_per_unit"), SettingValue(8.0));
  EXPECT_EQ(hall.overrides.size(), 1U);
  EXPECT_EQ(value(yard, "file"), SettingValue(std::string("yard.blend")));
  EXPECT_EQ(value(yard, "dir"), SettingValue(std::string("game/yard-maps")));
  EXPECT_EQ(value(yard, "samples"), SettingValue(std::int64_t{64}));
  EXPECT_THROW((void)value(yard, "texels_per_unit"), std::logic_error) << "its own resolution turns it off";
  ASSERT_EQ(yard.overrides.size(), 2U);
  EXPECT_TRUE(yard.overrides[0].is_shared);
  EXPECT_FALSE(yard.overrides[1].is_shared);
  EXPECT_EQ(yard.overrides[1].where, "game/project.toml:15");
}

struct BadProject {
  const char *name, *text, *message;
};

class BadProjects : public testing::TestWithParam<BadProject> {};

TEST_P(BadProjects, NameLineFaultAndRemedy) {
  EXPECT_EQ(refusal(GetParam().text), std::string("some/project.toml:") + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    ProjectFile, BadProjects,
    testing::Values(
        BadProject{"UnknownKey", "[bake]\n\nsampels = 3\n",
                   "3: unknown key 'sampels' in [bake], did you mean 'samples'?"},
        BadProject{"UnknownKeyWithoutHint", "[bake]\nxyzzyplugh = 3\n",
                   "2: unknown key 'xyzzyplugh' in [bake]"},
        BadProject{"UnknownTable", "[bakee]\n", "1: unknown table 'bakee', did you mean 'bake'?"},
        BadProject{"OtherTablesKey", "[output]\nsamples = 3\n",
                   "2: 'samples' does not belong in [output]; move it to [bake]"},
        BadProject{"OutsideOfTables", "samples = 3\n",
                   "1: 'samples' stands outside of any table; move it to [bake]"},
        BadProject{"TableAsValue", "bake = 3\n", "1: 'bake' is a whole number; write a table: [bake]"},
        BadProject{"TextForNumber", "[bake]\nsamples = \"3\"\n",
                   "2: 'samples' is a text; give a whole number from 1 to 16777216"},
        BadProject{"RealForWhole", "[bake]\nsamples = 3.5\n",
                   "2: 'samples' is a number; give a whole number from 1 to 16777216"},
        BadProject{"NumberForText", "[bake]\nuv = 3\n", "2: 'uv' is a whole number; give text"},
        BadProject{"NumberForBool", "[bake]\nflip_green = 1\n",
                   "2: 'flip_green' is a whole number; give true or false"},
        BadProject{"ListOfNumbers", "[scene]\nobjects = [1]\n",
                   "2: 'objects' is a list; give a list of texts"},
        BadProject{"TooSmall", "[bake]\nresolution = 3\n",
                   "2: 3 does not fit 'resolution'; give a whole number from 4 to 16384"},
        BadProject{"Infinite", "[bake]\nclamp = inf\n",
                   "2: inf does not fit 'clamp'; give a number from 0 to 1000000000"},
        BadProject{"BadChoice", "[output]\ndepth = \"flaot\"\n",
                   "2: 'flaot' does not fit 'depth'; give half or float, did you mean 'float'?"},
        BadProject{"OverrideWithoutObjects", "[[override]]\nsamples = 3\n",
                   "1: [[override]] names no objects; add objects = \"floor*\""},
        BadProject{"OverrideOfNothing", "[[override]]\nobjects = []\n",
                   "2: 'objects' is not a list of names; give a name or a list of names"},
        BadProject{"OverrideOfGlobal", "[[override]]\nobjects = \"a\"\nbounces = 3\n",
                   "3: 'bounces' holds for the whole bake; move it to [bake]"},
        BadProject{"OverrideUnknown", "[[override]]\nobjects = \"a\"\nsampels = 3\n",
                   "3: unknown key 'sampels' in [[override]], did you mean 'samples'?"},
        BadProject{"SceneWithoutFile", "[[scenes]]\nsamples = 3\n",
                   "1: [[scenes]] names no scene; add file = \"hall.blend\""},
        BadProject{"SceneUnknown", "[[scenes]]\nfile = 'a.blend'\nsampels = 3\n",
                   "3: unknown key 'sampels' in [[scenes]], did you mean 'samples'?"},
        BadProject{"SceneAndScenes", "[scene]\nfile = 'b.blend'\n[[scenes]]\nfile = 'a.blend'\n",
                   "2: [scene] names a file beside [[scenes]]; make it a [[scenes]] of its own"},
        BadProject{"ListOfScene", "[[scene]]\nfile = 'b.blend'\n",
                   "1: a list of scenes is written [[scenes]]; [scene] is what holds for all of them"},
        BadProject{"SingleScenes", "[scenes]\nfile = 'b.blend'\n",
                   "1: 'scenes' is a list of tables; write [[scenes]]"},
        BadProject{"SingleOverride", "[override]\nobjects = \"a\"\n",
                   "1: 'override' is a list of tables; write [[override]]"}),
    [](const auto& one) { return one.param.name; });

TEST(ProjectFile, WhatIsNotTomlNamesTheLine) {
  EXPECT_EQ(refusal("[bake]\nsamples = = 3\n").rfind("some/project.toml:2: not TOML: ", 0), 0U);
  EXPECT_EQ(refusal("[bake]\nseed = 1\nseed = 2\n").rfind("some/project.toml:3: not TOML: ", 0), 0U);
}

TEST(ProjectFile, AMissingOneIsAnIoError) {
  try {
    (void)read_project("/nonexistent/project.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_STREQ(error.what(),
                 "cannot read /nonexistent/project.toml: No such file or directory; check the path");
  }
}

}  // namespace
}  // namespace rnmbake
