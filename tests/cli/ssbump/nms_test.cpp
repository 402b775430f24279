// The command as a user calls it: exit codes, messages and files.
#include "base/files.h"
#include "cli/command_test.h"
#include "encoding/rnm.h"
#include "image/layered_exr.h"
#include "lightmap/merge.h"
#include "lightmap/metadata.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

class NmsCommand : public CommandTest {
 protected:
  void SetUp() override {
    metadata_.bases = rnm_set().directions;
    metadata_.bases.push_back(flat_direction());
    normals_ = write_normals("n.exr");
  }

  /// A roof along the columns of a 64 x 8 map, as vectors.
  [[nodiscard]] std::string write_normals(const std::string& name, float green = 0) const {
    FloatImage normals(64, 8, 3);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 64; ++x) {
        const float slope = x >= 24 && x < 32 ? 3.0F : x >= 32 && x < 40 ? -3.0F : 0.0F;
        const Vec3 n = unit(Vec3(-slope, green, 1));
        std::ranges::copy(std::array{n.x, n.y, n.z}, normals.texel(x, y).begin());
      }
    }
    write_exr(path(name), {{{"", {"X", "Y", "Z"}, normals}}, {}}, Depth::full);
    return path(name);
  }

  [[nodiscard]] std::string lightmap(const std::string& name, const Vec3& sun, float nan_at_rnm = 0) const {
    TargetBakes bakes;
    for (const BasisDirection& basis : metadata_.bases) {
      FloatImage map(4, 4, 3);
      std::ranges::fill(map.data(), std::max(0.0F, basis.direction.dot(sun)));
      if (basis.name == "rnm1") map.data()[7] += nan_at_rnm;
      bakes.bases.push_back({basis.name, basis.direction, map});
    }
    bakes.coverage = FloatImage(4, 4, 1);
    std::ranges::fill(bakes.coverage.data(), 1.0F);
    MergedLightmap merged = merge(bakes, {.depth = Depth::full});
    write_metadata(metadata_, merged.image);
    if (nan_at_rnm != 0) {
      for (Layer& layer : merged.image.layers)
        if (layer.name == "rnm1") layer.pixels.data()[7] = nan_at_rnm;
    }
    write_exr(path(name), merged.image, Depth::full);
    return path(name);
  }

  int nms(const std::vector<std::string>& arguments) { return call("nms", arguments); }

  [[nodiscard]] FloatImage read(const std::string& name) const {
    return read_image(path(name)).layers[0].pixels;
  }

  LightmapMetadata metadata_;
  std::string normals_;
};

TEST_F(NmsCommand, EndingsAndBits) {
  const std::vector<std::string> call{"--normal", normals_, "--light", "1,0,0.4", "--hard", "-o"};
  const auto with = [&](const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> words = call;
    words.push_back(path(name));
    words.insert(words.end(), more.begin(), more.end());
    return nms(words);
  };
  ASSERT_EQ(with("a.exr"), 0) << said_;
  ASSERT_EQ(with("a.png"), 0) << said_;
  ASSERT_EQ(with("b.png", {"--bits", "16"}), 0) << said_;
  ASSERT_EQ(with("a.tif", {"--bits", "16"}), 0) << said_;
  const FloatImage exact = read("a.exr");
  EXPECT_EQ(exact.channels(), 1);
  EXPECT_EQ(exact.texel(20, 4)[0], 0);
  EXPECT_EQ(exact.texel(50, 4)[0], 1);
  for (const char* name : {"a.png", "b.png", "a.tif"}) EXPECT_EQ(read(name).data(), exact.data()) << name;
  EXPECT_EQ(read_image(path("a.exr")).attributes["rnmbake:steps"], Attribute(32));
  EXPECT_EQ(with("a.jpg"), 1);
  EXPECT_TRUE(said(".jpg")) << said_;
}

TEST_F(NmsCommand, LitIsTheShareTimesTheCosine) {
  ASSERT_EQ(nms({"--normal", normals_, "--light", "3,0,4", "--lit", "-o", path("lit.exr")}), 0) << said_;
  EXPECT_NEAR(read("lit.exr").texel(55, 1)[0], 0.8, 1e-6);
  EXPECT_NEAR(read("lit.exr").texel(28, 1)[0], 0, 1e-6);  // faces away
}

TEST_F(NmsCommand, ALightmapOfOneSunIsThatLight) {
  const Vec3 sun = unit(Vec3(0.5F, 0, 1));
  const std::string map = lightmap("sun.exr", sun);
  ASSERT_EQ(nms({"--normal", normals_, "--lightmap", map, "-o", path("baked.exr")}), 0) << said_;
  ASSERT_EQ(nms({"--normal", normals_, "--light", "0.5,0,1", "--lit", "-o", path("lit.exr")}), 0) << said_;
  const FloatImage baked = read("baked.exr"), lit = read("lit.exr");
  ASSERT_EQ(baked.channels(), 3);
  for (std::size_t i = 0; i < lit.texels(); ++i)
    EXPECT_NEAR(baked.data()[3 * i + 1], lit.data()[i], 1e-5) << i;
  ASSERT_EQ(nms({"--normal", normals_, "--lightmap", map, "--repeat", "2,3", "-o", path("many.exr")}), 0)
      << said_;
  EXPECT_EQ(read("many.exr").width(), 128);
  EXPECT_EQ(read("many.exr").height(), 24);
}

TEST_F(NmsCommand, CheckSaysHowFarTheNormalsAreFromASurface) {
  ASSERT_EQ(nms({"--normal", normals_, "--check"}), 0) << said_;
  EXPECT_NE(printed_.find("curl of the slopes"), std::string::npos) << printed_;
  ASSERT_EQ(nms({"--normal", normals_, "--check", "--json", "--bound", "0.5"}), 0) << said_;
  const auto json = nlohmann::json::parse(printed_);
  EXPECT_EQ(json["bound"], 0.5);
  EXPECT_EQ(json["width"], 64);
  ASSERT_EQ(json["scales"].size(), 1);  // too low for squares of 4 texels
  EXPECT_NEAR(json["scales"][0]["rms"], 0, 1e-6);
}

TEST_F(NmsCommand, JitterRepeatsByItsSeed) {
  const auto with_seed = [&](const std::string& seed, const std::string& name) {
    EXPECT_EQ(
        nms({"--normal", normals_, "--light", "1,0.3,0.5", "--jitter", "--seed", seed, "-o", path(name)}), 0);
    return read(name).data();
  };
  EXPECT_EQ(with_seed("3", "a.exr"), with_seed("3", "b.exr"));
  EXPECT_NE(with_seed("3", "a.exr"), with_seed("4", "b.exr"));
}

TEST_F(NmsCommand, BadCalls) {
  const std::string out = path("out.png");
  EXPECT_EQ(nms({"--light", "0,0,1", "-o", out}), 1);
  EXPECT_EQ(nms({"--normal", normals_, "-o", out}), 1);
  EXPECT_TRUE(said("--lightmap")) << said_;
  EXPECT_EQ(nms({"--normal", normals_, "--light", "0,0,1", "--check"}), 1);
  EXPECT_EQ(nms({"--normal", normals_, "--light", "0,0,1"}), 1);
  EXPECT_TRUE(said("-o FILE")) << said_;
  for (const char* light : {"0,0,0", "1,0,0", "1,0,-0.5", "1,2", "nan,0,1", "1,2,3,4"}) {
    EXPECT_EQ(nms({"--normal", normals_, "--light", light, "-o", out}), 1) << light;
    EXPECT_EQ(std::ranges::count(said_, '\n'), 1) << said_;
  }
  EXPECT_EQ(nms({"--normal", normals_, "--light", "0,0,1", "--steps", "0", "-o", out}), 1);
  EXPECT_EQ(nms({"--normal", normals_, "--light", "0,0,1", "--bits", "12", "-o", out}), 1);
  EXPECT_EQ(nms({"--normal", normals_, "--light", "0,0,1", "--green", "left", "-o", out}), 1);
  EXPECT_EQ(nms({"--normal", normals_, "--lightmap", lightmap("l.exr", {0, 0, 1}), "-o", out}), 1);
  EXPECT_TRUE(said(".exr")) << said_;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(NmsCommand, BadFiles) {
  const std::string out = path("out.exr");
  EXPECT_EQ(nms({"--normal", path("missing.png"), "--light", "0,0,1", "-o", out}), 2);
  write_atomically(path("text.png"), std::string_view("text"));
  EXPECT_EQ(nms({"--normal", path("text.png"), "--light", "0,0,1", "-o", out}), 3);
  EXPECT_EQ(nms({"--normal", normals_, "--light", "0,0,1", "-o", path("no/such/out.exr")}), 2);
  EXPECT_EQ(nms({"--normal", normals_, "--lightmap", path("missing.exr"), "-o", out}), 2);
  EXPECT_EQ(nms({"--normal", normals_, "--lightmap", normals_, "-o", out}), 5);
  EXPECT_TRUE(said("names no convention")) << said_;
  EXPECT_EQ(nms({"--normal", normals_, "--lightmap",
                 lightmap("nan.exr", {0, 0, 1}, std::numeric_limits<float>::quiet_NaN()), "-o", out}),
            3);
  EXPECT_TRUE(said("rnm1") && said("(2, 0)")) << said_;
  metadata_.bases.erase(metadata_.bases.begin(), metadata_.bases.begin() + 3);
  EXPECT_EQ(nms({"--normal", normals_, "--lightmap", lightmap("flat.exr", {0, 0, 1}), "-o", out}), 5);
  EXPECT_EQ(std::ranges::count(said_, '\n'), 1) << said_;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(NmsCommand, ScaledLightmapsDoNotTellADirection) {
  metadata_.normalize = Normalize::flat;
  EXPECT_EQ(nms({"--normal", normals_, "--lightmap", lightmap("l.exr", {0, 0, 1}), "-o", path("out.exr")}),
            5);
  EXPECT_TRUE(said("normalize flat")) << said_;
}

}  // namespace
}  // namespace rnmbake
