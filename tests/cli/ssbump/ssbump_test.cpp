// The command as a user calls it: height maps of every kind in, files and messages out.
#include "base/error.h"
#include "base/files.h"
#include "cli/command_test.h"
#include "image/picture_rows.h"
#include "ssbump/map/picture.h"
#include "ssbump/map/weights.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

class SsbumpCommand : public CommandTest {
 protected:
  int ssbump(const std::vector<std::string>& arguments) { return call("ssbump", arguments); }

  std::string write(const char* name, int width, int height, Storage storage, auto height_at) {
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) values.push_back(static_cast<float>(height_at(x, y)));
    PictureWriter writer(path(name), {width, height, {"Y"}, storage, {}});
    writer.write(0, height, values);
    writer.commit();
    return path(name);
  }

  std::string bumps(const char* name = "bumps.exr", int width = 24, int height = 16) {
    return write(name, width, height, Storage::full,
                 [](int x, int y) { return 2 * std::sin(0.8 * x) * std::cos(0.7 * y) + 3; });
  }

  [[nodiscard]] FloatImage weights(const std::string& name) const {
    return read_ssbump(path(name), {}).weights;
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()),
                                                  std::filesystem::directory_iterator()));
  }
};

TEST_F(SsbumpCommand, GivesTheSameWeightsUnderEachScaleHandednessAndFormat) {
  bumps();
  ASSERT_EQ(ssbump({path("bumps.exr"), "-f", "0", "-o", path("a.exr")}), 0) << said_;
  const FloatImage truth = weights("a.exr");
  int count = 0;
  for (const char* scale : {"third", "ndotb", "mod2x"}) {
    for (const char* handed : {"right", "left"}) {
      for (const char* ending : {".tif", ".png", ".tga", ".exr"}) {
        const std::string name = std::to_string(++count) + ending;
        ASSERT_EQ(
            ssbump({path("bumps.exr"), "-f", "0", "--scale", scale, "--handed", handed, "-o", path(name)}),
            0);
        const FloatImage got = weights(name);
        for (int y = 0; y < truth.height(); ++y)
          for (int x = 0; x < truth.width(); ++x)
            for (std::size_t c = 0; c < 3; ++c)
              ASSERT_NEAR(got.texel(x, y)[c], truth.texel(x, y)[c],
                          name.ends_with(".exr") ? 1e-6 : 3.5 / 255);
      }
    }
  }
}

TEST_F(SsbumpCommand, IsTheSameAtAnyNumberOfThreads) {
  bumps();
  ASSERT_EQ(ssbump({path("bumps.exr"), "--threads", "1", "-o", path("a.png")}), 0);
  ASSERT_EQ(ssbump({path("bumps.exr"), "--threads", "3", "-o", path("b.png")}), 0);
  EXPECT_EQ(read_text(path("a.png")), read_text(path("b.png")));
}

TEST_F(SsbumpCommand, TakesAzimuthsOrAnErrorButNotBoth) {
  bumps();
  EXPECT_EQ(ssbump({path("bumps.exr"), "--azimuths", "64", "--error", "0.01", "-o", path("s.exr")}),
            static_cast<int>(ExitCode::usage));
  EXPECT_TRUE(said("--azimuths excludes --error")) << said_;

  ASSERT_EQ(ssbump({path("bumps.exr"), "--azimuths", "20", "--json", "-o", path("s.exr")}), 0) << said_;
  auto json = nlohmann::json::parse(printed_);
  EXPECT_EQ(json["azimuths"], 20);
  EXPECT_FALSE(json.contains("rmse"));

  ASSERT_EQ(ssbump({path("bumps.exr"), "--error", "0.5", "--json", "-o", path("s.exr")}), 0) << said_;
  json = nlohmann::json::parse(printed_);
  EXPECT_EQ(json["azimuths"], 64);
  EXPECT_LE(json["rmse"].get<double>(), 0.5);
}

TEST_F(SsbumpCommand, WarnsWhereNoNumberOfAzimuthsIsEnough) {
  write("steps.exr", 64, 64, Storage::full, [](int x, int y) { return x / 16 + y / 16; });
  ASSERT_EQ(ssbump({path("steps.exr"), "-f", "0", "--height", "20", "--error", "1e-5", "-o", path("s.exr")}),
            0);
  EXPECT_TRUE(said("with 512 azimuths, which is the most that are tried")) << said_;
}

TEST_F(SsbumpCommand, KeepsToItsMemoryByPartsThatMakeTheSameMap) {
  for (const int height : {64, 2048}) {  // in one part, in more
    bumps("h.exr", 512, height);
    const std::vector<std::string> common{path("h.exr"), "-f", "0", "--azimuths", "4", "-o"};
    std::vector<std::string> whole = common, parts = common;
    whole.push_back(path("whole.exr"));
    parts.insert(parts.end(), {path("parts.exr"), "--memory-limit", "64"});
    ASSERT_EQ(ssbump(whole), 0) << said_;
    ASSERT_EQ(ssbump(parts), 0) << said_;
    const FloatImage expected = weights("whole.exr"), got = weights("parts.exr");
    ASSERT_EQ(got.data().size(), expected.data().size());
    for (std::size_t i = 0; i < got.data().size(); ++i)
      ASSERT_NEAR(got.data()[i], expected.data()[i], 1e-5) << height << ' ' << i;
  }
}

TEST_F(SsbumpCommand, TakesAnySize) {
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(1, 17), std::pair(33, 1), std::pair(7, 5), std::pair(101, 3)}) {
    bumps("h.exr", width, height);
    for (const char* wrap : {"x,y", "none", "mirror", "x", "none,wrap"}) {
      ASSERT_EQ(ssbump({path("h.exr"), "--wrap", wrap, "--alpha", "up", "-o", path("s.exr")}), 0) << said_;
      const FloatImage got = weights("s.exr");
      ASSERT_EQ(got.width(), width);
      ASSERT_EQ(got.height(), height);
      for (const float value : got.data()) ASSERT_TRUE(value >= 0 && value <= 1.001F) << value;
    }
  }
}

TEST_F(SsbumpCommand, ReadsPalettes) {
  // TGA, 2 x 1, 8-bit indices into four grey colours: 3, 0.
  const std::string tga{0, 1,    1, 0, 0, 4,  0,  24, 0,  0,  0,  0,   2,   0,   1, 0,
                        8, 0x20, 0, 0, 0, 50, 50, 50, 90, 90, 90, 100, 100, 100, 3, 0};
  std::ofstream(path("p.tga"), std::ios::binary) << tga;
  ASSERT_EQ(ssbump({path("p.tga"), "--json", "-f", "0", "--height", "255", "-D", path("d.exr"), "-o",
                    path("s.exr"), "--wrap", "none"}),
            0)
      << said_;
  const auto json = nlohmann::json::parse(printed_);
  EXPECT_EQ(json["channel"], "luminance");
  EXPECT_NEAR(json["highest"].get<double>(), 100 / 255.0, 1e-6);
  EXPECT_EQ(json["lowest"], 0);
}

TEST_F(SsbumpCommand, WritesNormalsAndHeightsBesideTheMap) {
  write("ramp.exr", 16, 8, Storage::full, [](int x, int) { return 0.5 * x; });
  ASSERT_EQ(ssbump({path("ramp.exr"), "--wrap", "none", "-f", "0", "-n", path("n.exr"), "-D", path("d.exr"),
                    "-o", path("s.exr")}),
            0)
      << said_;
  std::vector<float> normal(16 * 3), height(16);
  PictureReader(path("n.exr")).read(4, 5, 0, 3, normal);
  PictureReader(path("d.exr")).read(4, 5, 0, 1, height);
  EXPECT_NEAR(2 * normal[3 * 7] - 1, -0.5 / std::sqrt(1.25), 1e-5);
  EXPECT_NEAR(2 * normal[3 * 7 + 2] - 1, 1 / std::sqrt(1.25), 1e-5);
  EXPECT_FLOAT_EQ(height[7], 3.5F);
}

TEST_F(SsbumpCommand, NamesTheTexelThatHasNoHeight) {
  write("nan.exr", 5, 3, Storage::full,
        [](int x, int y) { return x == 3 && y == 1 ? std::numeric_limits<double>::quiet_NaN() : 1; });
  const std::size_t before = files();
  EXPECT_EQ(ssbump({path("nan.exr"), "-n", path("n.png"), "-o", path("s.png")}), 3);
  EXPECT_TRUE(said("texel (3, 1) from the top left is NaN")) << said_;
  EXPECT_EQ(files(), before);
}

TEST_F(SsbumpCommand, LeavesNothingWhereOneFileCannotBeWritten) {
  bumps();
  const std::size_t before = files();
  EXPECT_EQ(ssbump({path("bumps.exr"), "-n", path("n.exr"), "-o", path("none/s.exr")}), 2);
  EXPECT_EQ(files(), before);
}

TEST_F(SsbumpCommand, FlippedTwiceIsItself) {
  bumps();
  ASSERT_EQ(ssbump({path("bumps.exr"), "--alpha", "up", "-o", path("a.tga")}), 0);
  ASSERT_EQ(ssbump({"flip", path("a.tga"), "-o", path("b.tga")}), 0) << said_;
  ASSERT_EQ(ssbump({"flip", path("b.tga"), "-o", path("c.tga")}), 0) << said_;
  EXPECT_EQ(read_text(path("a.tga")), read_text(path("c.tga")));
  EXPECT_NE(read_text(path("a.tga")), read_text(path("b.tga")));
}

TEST_F(SsbumpCommand, ModulatesByTheAlbedoEvenly) {
  bumps();
  write("albedo.exr", 24, 16, Storage::full, [](int x, int) { return x < 12 ? 0.25 : 1.0; });
  ASSERT_EQ(ssbump({path("bumps.exr"), "-o", path("a.exr")}), 0);
  ASSERT_EQ(ssbump({path("bumps.exr"), "--albedo", path("albedo.exr"), "-o", path("b.exr")}), 0) << said_;
  ASSERT_EQ(ssbump({path("bumps.exr"), "--albedo", path("albedo.exr"), "--no-modulate", "-o", path("c.exr")}),
            0);
  const FloatImage plain = weights("a.exr"), modulated = weights("b.exr"), bare = weights("c.exr");
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(modulated.texel(5, 5)[c], 0.25F * plain.texel(5, 5)[c], 1e-6);
    EXPECT_NEAR(modulated.texel(20, 5)[c], plain.texel(20, 5)[c], 1e-6);
    EXPECT_EQ(bare.texel(5, 5)[c], plain.texel(5, 5)[c]);
  }
  write("small.exr", 4, 4, Storage::full, [](int, int) { return 1; });
  EXPECT_EQ(ssbump({path("bumps.exr"), "--albedo", path("small.exr"), "-o", path("d.exr")}), 3);
}

}  // namespace
}  // namespace rnmbake
