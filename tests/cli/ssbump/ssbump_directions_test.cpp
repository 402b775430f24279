// Maps of a set of directions as a user makes, reads and decodes them.
#include "base/error.h"
#include "base/files.h"
#include "cli/command_test.h"
#include "encoding/direction_sets.h"
#include "image/layered_exr.h"
#include "image/picture_rows.h"
#include "lightmap/merge.h"
#include "lightmap/metadata.h"
#include "ssbump/map/direction_map.h"
#include "support/pictures.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

class SsbumpDirections : public CommandTest {
 protected:
  void SetUp() override {
    std::vector<float> values;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        values.push_back(static_cast<float>(std::sin(0.785398 * x) * std::cos(0.785398 * y)));
    write_heights("bumps.exr", values);
    write_heights("flat.exr", std::vector<float>(64, 1));
  }

  void write_heights(const char* name, const std::vector<float>& values) {
    PictureWriter writer(path(name), {8, 8, {"Y"}, Storage::full, {}});
    writer.write(0, 8, values);
    writer.commit();
  }

  int make(const std::string& heights, std::vector<std::string> more, const char* output = "map.exr") {
    more.insert(more.begin(), {path(heights), "-f", "0", "-o", path(output)});
    return call("ssbump", more);
  }

  /// A lightmap of a set under a uniform sky.
  std::string sky(const BasisSet& set) {
    TargetBakes bakes;
    LightmapMetadata metadata;
    metadata.bases = set.directions;
    for (const auto& [name, direction] : set.directions)
      bakes.bases.push_back({name, direction, filled(4, 4, 3, (1 + direction.z) / 2)});
    bakes.coverage = filled(4, 4, 1, 1);
    MergedLightmap merged = merge(bakes, {.depth = Depth::full});
    write_metadata(metadata, merged.image);
    write_exr(path("sky.exr"), merged.image, Depth::full);
    return path("sky.exr");
  }
};

TEST_F(SsbumpDirections, AFlatMapOverALightmapOfItsSetIsTheFlatBake) {
  ASSERT_EQ(make("flat.exr", {"--basis-set", "h6"}), 0) << said_;
  ASSERT_EQ(call("decode", {sky(*direction_set("h6")), "--ssbump", path("map.exr"), "-o", path("lit.exr")}),
            0)
      << said_;
  const LayeredImage lit = read_image(path("lit.exr"));
  for (const float value : lit.layers.front().pixels.data()) EXPECT_NEAR(value, 1, 1e-3);
}

TEST_F(SsbumpDirections, InfoNamesTheSetAndItsDirections) {
  ASSERT_EQ(make("bumps.exr", {"--basis-set", "sh3", "--bits", "16", "--fit", "positive"}), 0) << said_;
  ASSERT_EQ(call("ssbump", {"info", path("map.exr"), "--json"}), 0) << said_;
  const auto json = nlohmann::json::parse(printed_);
  EXPECT_EQ(json["set"], "sh3");
  EXPECT_EQ(json["storage"], "half");
  EXPECT_EQ(json["fit"], "positive");
  EXPECT_EQ(json["method"], "trace");
  EXPECT_EQ(json["basis"].size(), 13);
  for (const auto& [name, range] : json["weights"].items()) EXPECT_GE(range["least"], 0) << name;
  ASSERT_EQ(call("ssbump", {"info", path("map.exr")}), 0);
  EXPECT_NE(printed_.find("sh3: 13 directions"), std::string::npos);
}

TEST_F(SsbumpDirections, TakesABasisFile) {
  write_atomically(path("two.toml"),
                   "[[basis]]\nname = \"up\"\ndirection = [0, 0, 1]\n[[basis]]\nname = \"side\"\n"
                   "direction = [0.6, 0, 0.8]\n");
  ASSERT_EQ(make("bumps.exr", {"--basis-set", path("two.toml")}), 0) << said_;
  const auto map = read_direction_map(path("map.exr"));
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->metadata.set.name, "two.toml");
  ASSERT_EQ(map->metadata.set.directions.size(), 2);
  EXPECT_EQ(map->metadata.set.directions[1].name, "side");
}

TEST_F(SsbumpDirections, RefusesWhatDoesNotGoTogetherAndLeavesNoFile) {
  const std::vector<std::pair<std::vector<std::string>, const char*>> cases{
      {{"--basis-set", "h7"}, "is no set and no file"},
      {{"--basis-set", "h6", "--method", "horizon"}, "leave out --method"},
      {{"--basis-set", "h6", "--power", "4"}, "--power does not go with"},
      {{"--basis-set", "h6", "--alpha", "up"}, "without --basis-set"},
      {{"--basis-set", "h6", "--handed", "left"}, "right-handed"},
      {{"--basis-set", "h6", "--scale", "ndotb"}, "--scale"},
      {{"--basis-set", "h6", "--bounces", "1"}, "--bounces"},
      {{"--basis-set", "h6", "--rays", "79"}, "--rays 80 or more"},
      {{"--basis-set", "h6", "--bits", "8"}, "give 16 or float"},
      {{"--fit", "free"}, "--basis-set"}};
  for (const auto& [flags, message] : cases) {
    EXPECT_EQ(make("bumps.exr", flags), static_cast<int>(ExitCode::usage)) << message;
    EXPECT_TRUE(said(message)) << said_;
    EXPECT_FALSE(std::filesystem::exists(path("map.exr"))) << message;
  }
  EXPECT_EQ(make("bumps.exr", {"--basis-set", "h6"}, "map.png"), static_cast<int>(ExitCode::usage));
  EXPECT_TRUE(said("give -o FILE.exr")) << said_;
}

TEST_F(SsbumpDirections, OtherSetsAndToolsOfTheThreeAxesAreRefused) {
  ASSERT_EQ(make("bumps.exr", {"--basis-set", "h6"}), 0) << said_;
  EXPECT_EQ(call("decode", {sky(*direction_set("l1")), "--ssbump", path("map.exr"), "-o", path("lit.exr")}),
            static_cast<int>(ExitCode::unsupported));
  EXPECT_TRUE(said("is of the set h6 and the lightmap of l1")) << said_;
  EXPECT_EQ(call("decode", {sky(*direction_set("h6")), "--ssbump", path("map.exr"), "--variant", "vrad", "-o",
                            path("lit.exr")}),
            static_cast<int>(ExitCode::usage));
  EXPECT_EQ(call("ssbump", {"to-normal", path("map.exr"), "-o", path("n.png")}),
            static_cast<int>(ExitCode::unsupported));
  EXPECT_TRUE(said("made without --basis-set")) << said_;
}

}  // namespace
}  // namespace rnmbake
