#include "config/resolve.h"

#include "base/error.h"
#include "config/document.h"
#include "config/value.h"
#include "config/variables.h"

#include <fstream>
#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Texts = std::map<std::string, std::string>;

/// Flags and variables by key.
ResolvedConfig resolved(const std::string& project, const Texts& variables = {}, const Texts& flags = {}) {
  const auto lookup = [&](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
  std::vector<SettingOverride> given;
  for (const auto& [key, text] : flags) {
    const Setting& setting = *find_setting(key);
    SettingOverride one{&setting, parse_value(setting, text, "flag"), SettingSource::flag,
                        "flag " + setting.flag()};
    given.push_back(one);
  }
  return resolve(parse_project(project, "project.toml"), read_environment(lookup), given);
}

std::string refusal(const std::function<void()>& action, ExitCode code = ExitCode::usage) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  return "accepted";
}

TEST(Resolve, FlagOverEnvironmentOverProjectOverDefault) {
  const std::string project = "[bake]\nsamples = 2\nbounces = 2\nseed = 2\n";
  const Texts variables{{"RNMBAKE_SAMPLES", "3"}, {"RNMBAKE_BOUNCES", "3"}, {"RNMBAKE_DILATE", ""}};
  const ResolvedConfig config = resolved(project, variables, {{"samples", "4"}});
  EXPECT_EQ(config.globals.object.samples, 4);
  EXPECT_EQ(config.provenance("samples"), "flag --samples");
  EXPECT_EQ(config.globals.bake.bounces, 3);
  EXPECT_EQ(config.provenance("bounces"), "RNMBAKE_BOUNCES");
  EXPECT_EQ(config.globals.object.seed, 2);
  EXPECT_EQ(config.provenance("seed"), "project.toml:4");
  EXPECT_EQ(config.globals.object.dilate, 4);  // an empty variable counts as not set
  EXPECT_EQ(config.provenance("dilate"), "default");
}

TEST(Resolve, ABadVariableIsNamed) {
  EXPECT_EQ(refusal([] {
              (void)resolved("", {{"RNMBAKE_SAMPLES", "lots"}});
            }),
            "RNMBAKE_SAMPLES: 'lots' does not fit 'samples'; give a whole number from 1 to 16777216");
}

constexpr const char* overrides = R"([bake]
samples = 10
seed = 10

[[override]]
objects = "floor*"
samples = 20
seed = 20

[[override]]
objects = ["floor_2", "door/*#1"]
samples = 30
)";

TEST(Resolve, TheLastOverrideThatMatchesWins) {
  const ResolvedConfig config = resolved(overrides);
  EXPECT_EQ(config.for_object("wall", "wall").samples, 10);
  EXPECT_EQ(config.for_object("floor_1", "floor_1").samples, 20);
  const ObjectSettings both = config.for_object("floor_2", "floor_2");
  EXPECT_EQ(both.samples, 30);
  EXPECT_EQ(both.seed, 20);                                         // the second says nothing about it
  EXPECT_EQ(config.for_object("leaf", "door/leaf#1").samples, 30);  // by key
  EXPECT_EQ(config.for_object("leaf", "door/leaf#2").samples, 10);
}

TEST(Resolve, FlagsAndEnvironmentWinOverOverrides) {
  const ResolvedConfig config = resolved(overrides, {{"RNMBAKE_SEED", "99"}}, {{"samples", "1"}});
  EXPECT_EQ(config.for_object("floor_2", "floor_2").samples, 1);
  EXPECT_EQ(config.for_object("floor_2", "floor_2").seed, 99);
}

TEST(Resolve, TheStrongerOfResolutionAndTexelsPerUnitCounts) {
  const std::string project =
      "[bake]\ntexels_per_unit = 8\nresolution = 64\n[[override]]\nobjects = \"a\"\nresolution = 32\n"
      "[[override]]\nobjects = \"b\"\nresolution = 32\ntexels_per_unit = 4\n";
  const ResolvedConfig plain = resolved(project);
  EXPECT_EQ(plain.globals.object.texels_per_unit, 8);
  EXPECT_EQ(plain.for_object("a", "a").texels_per_unit, 0);
  EXPECT_EQ(plain.for_object("a", "a").resolution, 32);
  EXPECT_EQ(plain.for_object("b", "b").texels_per_unit, 4);
  const ResolvedConfig fixed = resolved(project, {}, {{"resolution", "128"}});
  EXPECT_EQ(fixed.globals.object.texels_per_unit, 0);
  EXPECT_EQ(fixed.provenance("texels_per_unit"), "flag --resolution");
  EXPECT_EQ(fixed.for_object("b", "b").texels_per_unit, 0);
  EXPECT_EQ(fixed.for_object("b", "b").resolution, 128);
  const ResolvedConfig by_surface = resolved(project, {}, {{"texels_per_unit", "2"}});
  EXPECT_EQ(by_surface.for_object("a", "a").texels_per_unit, 2);
}

TEST(Resolve, BasesAreCompleteUnlessNamedAndFreeWithABasisFile) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(resolved("").globals.bake.bases, (Names{"flat", "rnm0", "rnm1", "rnm2"}));
  EXPECT_EQ(resolved("[bake]\nbases = [\"rnm1\", \"flat\"]\n").globals.bake.bases, (Names{"rnm1", "flat"}));
  EXPECT_TRUE(resolved("[bake]\nbasis = \"b.toml\"\n").globals.bake.bases.empty());
  EXPECT_EQ(resolved("[bake]\nbasis = \"b.toml\"\nbases = [\"up\"]\n").globals.bake.bases, Names{"up"});
}

TEST(Resolve, ValuesThatContradictEachOtherAreRefused) {
  EXPECT_EQ(refusal([] {
              (void)resolved("", {}, {{"min_resolution", "64"}, {"max_resolution", "32"}});
            }),
            "flag --min-resolution: min_resolution = 64 is above max_resolution = 32; change one of them");
  EXPECT_EQ(refusal([] {
              (void)resolved("[[override]]\nobjects = \"a\"\nmax_resolution = 8\n").for_object("a", "a");
            }),
            "object 'a': min_resolution = 16 is above max_resolution = 8; change one of them");
  EXPECT_EQ(refusal([] { (void)resolved("[bake]\nbases = [\"rnm3\"]\n"); }),
            "project.toml:2: unknown basis 'rnm3'; give flat, rnm0, rnm1, rnm2, did you mean 'rnm0'?");
  EXPECT_EQ(refusal([] { (void)resolved("[bake]\nbases = [\"flat\", \"flat\"]\n"); }),
            "project.toml:2: 'flat' stands twice in 'bases'; name it once");
  EXPECT_EQ(refusal([] {
              (void)resolved("[bake]\nbases = [\"rnm0\"]\n", {}, {{"normalize", "flat"}});
            }),
            "flag --normalize: normalize = flat needs the flat bake; add flat to 'bases' (project.toml:2)");
}

TEST(Resolve, SelectsByGlob) {
  const ResolvedConfig config = resolved("[scene]\nobjects = [\"wall?\", \"f*\"]\nexclude = \"f_bad*\"\n");
  EXPECT_TRUE(config.selects("wall1", "wall1"));
  EXPECT_FALSE(config.selects("wall10", "wall10"));
  EXPECT_TRUE(config.selects("floor", "floor"));
  EXPECT_FALSE(config.selects("f_bad.001", "f_bad.001"));
  EXPECT_FALSE(config.selects("lamp", "lamp"));
  EXPECT_TRUE(resolved("").selects("anything", "a/b#1"));
}

TEST(Resolve, PatternsThatMatchNothingAreReported) {
  const std::vector<std::string> names{"floor_2", "wall"};
  EXPECT_EQ(unmatched({"floor*", "roof*", "wall", "Wall"}, names),
            (std::vector<std::string>{"roof*", "Wall"}));
  const auto lonely = unmatched_patterns(resolved(overrides, {}, {{"exclude", "sky,wall"}}), names);
  ASSERT_EQ(lonely.size(), 2U);
  EXPECT_EQ(lonely[0].pattern, "sky");
  EXPECT_EQ(lonely[0].where, "flag --exclude");
  EXPECT_EQ(lonely[1].pattern, "door/*#1");
  EXPECT_EQ(lonely[1].where, "project.toml:10");
  EXPECT_TRUE(unmatched_patterns(resolved(""), {}).empty());
}

TEST(Resolve, WhatIsPrintedReadsBackAsTheSame) {
  const ResolvedConfig config = resolved(overrides, {{"RNMBAKE_CLAMP", "2.5"}},
                                         {{"uv", "a \"b\\c"}, {"objects", "a,b"}, {"seed", "7"}});
  const std::string printed = print_config(config);
  EXPECT_NE(printed.find("clamp = 2.5                              # RNMBAKE_CLAMP\n"), std::string::npos);
  EXPECT_NE(printed.find("# project.toml:8, but flag --seed wins\n"), std::string::npos);
  const ResolvedConfig again = resolved(printed);
  for (const Setting& setting : settings()) {
    EXPECT_EQ(setting.slot.get(again.globals), setting.slot.get(config.globals)) << setting.key;
  }
  EXPECT_EQ(again.overrides().size(), 2U);
  EXPECT_EQ(again.for_object("floor_2", "floor_2").samples, 30);
}

TEST(Resolve, TheSceneMustBeOneAndExist) {
  const auto require = [](const std::string& file) {
    require_scene(resolved("", {}, file.empty() ? Texts{} : Texts{{"file", file}}));
  };
  const std::string folder = testing::TempDir();
  std::ofstream(folder + "/Scene.GLB") << "x";
  EXPECT_NO_THROW(require(folder + "/Scene.GLB"));
  EXPECT_EQ(refusal([&] { require("picture.png"); }),
            "picture.png: not a scene by its ending; give a .blend, .glb or .gltf file, or a project .toml");
  EXPECT_EQ(refusal([&] { require("missing.blend"); }, ExitCode::io),
            "missing.blend: no such scene file; check the path (flag --file)");
  EXPECT_EQ(refusal([&] { require(""); }).rfind("no scene: ", 0), 0U);
  EXPECT_TRUE(is_project_path("a/b.TOML"));
  EXPECT_FALSE(is_project_path("a.toml/b.blend"));
}

TEST(Resolve, OnlyAReferenceTakesAnExportedScene) {
  const ResolvedConfig config = resolved("", {}, {{"file", "missing.rnmscene"}});
  EXPECT_NE(refusal([&] { require_scene(config); }).find("not a scene by its ending"), std::string::npos);
  EXPECT_NE(refusal([&] { require_scene(config, Purpose::reference); }, ExitCode::io).find("no such scene"),
            std::string::npos);
}

TEST(Resolve, PrintsTheSettingsOfACommand) {
  const ResolvedConfig config = resolved("");
  EXPECT_EQ(print_config(config).find("[reference]"), std::string::npos);
  const std::string reference = print_config(config, Purpose::reference);
  EXPECT_NE(reference.find("[reference]"), std::string::npos);
  EXPECT_EQ(reference.find("recipe ="), std::string::npos);
}

TEST(Resolve, TheReferenceInTheDocsIsTheTable) {
  std::ifstream in(RNMBAKE_SOURCE_DIR "/docs/project-file.md");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string begin = "<!-- settings: rnmbake bake --print-settings-doc -->\n",
                    end = "<!-- end of settings -->";
  const auto from = text.find(begin), to = text.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(text.substr(from + begin.size(), to - from - begin.size()), settings_reference())
      << "replace the section by what `rnmbake bake --print-settings-doc` prints";
}

TEST(Environment, AMistypedVariableIsNamed) {
  EXPECT_NO_THROW(refuse_unknown_variables({"PATH", "RNMBAKE", "RNMBAKE_SAMPLES", "RNMBAKE_CHROMIUM"}));
  try {
    refuse_unknown_variables({"HOME", "RNMBAKE_SAMPELS"});
    FAIL() << "it was ignored";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("RNMBAKE_SAMPELS"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("'RNMBAKE_SAMPLES'"), std::string::npos) << error.what();
  }
}

TEST(Resolve, PatternsOfSeveralScenesNeedNotMatchInEach) {
  const std::string project =
      "[scene]\nexclude = 'proxy'\n[[override]]\nobjects = 'floor'\nsamples = 2\n"
      "[[scenes]]\nfile = 'a.blend'\n[[scenes.override]]\nobjects = 'gate'\nsamples = 3\n"
      "[[scenes]]\nfile = 'b.blend'\nexclude = 'sky'\n";
  const ProjectFile read = parse_project(project, "project.toml");
  const auto patterns = [&](std::size_t scene) {
    std::vector<std::string> all;
    for (const UnmatchedPattern& one :
         unmatched_patterns(resolve(read.of_scene(read.scenes[scene]), {}, {}), {"wall"}))
      all.push_back(one.pattern);
    return all;
  };
  EXPECT_EQ(patterns(0), std::vector<std::string>{"gate"});
  EXPECT_EQ(patterns(1), std::vector<std::string>{"sky"});
}

}  // namespace
}  // namespace rnmbake
