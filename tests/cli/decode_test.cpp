// The command as a user calls it: exit codes, messages and files.
#include "base/files.h"
#include "cli/command_test.h"
#include "encoding/rnm.h"
#include "image/layered_exr.h"
#include "lightmap/layout.h"
#include "lightmap/merge.h"
#include "lightmap/metadata.h"
#include "support/pictures.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

class DecodeCommand : public CommandTest {
 protected:
  void SetUp() override {
    metadata_.bases = rnm_set().directions;
    metadata_.bases.push_back(flat_direction());
  }

  /// A lightmap under a uniform sky, with the header as it is at this moment.
  std::string sky(const std::string& name) {
    TargetBakes bakes;
    for (const BasisDirection& basis : metadata_.bases)
      bakes.bases.push_back({basis.name, basis.direction, filled(4, 4, 3, (1 + basis.direction.z) / 2)});
    bakes.coverage = filled(4, 4, 1, 1);
    MergedLightmap merged = merge(bakes, {.depth = Depth::full});
    write_metadata(metadata_, merged.image);
    write_exr(path(name), merged.image, Depth::full);
    return path(name);
  }

  /// Runs `rnmbake decode ARGUMENTS -o out.exr`.
  int decode(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", path("out.exr")});
    return call("decode", arguments);
  }

  [[nodiscard]] float result() const { return read_image(path("out.exr")).find("")->pixels.data()[0]; }

  LightmapMetadata metadata_;
};

TEST_F(DecodeCommand, VariantsOfAFlatNormalUnderAUniformSky) {
  const std::string map = sky("sky.exr");
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1"}), 0) << said_;
  EXPECT_NEAR(result(), 0.788675, 1e-6);
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1", "--variant", "vrad", "--exposure", "1"}), 0) << said_;
  EXPECT_NEAR(result(), 2, 1e-6);
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1", "--variant", "linear"}), 0) << said_;
  EXPECT_NEAR(result(), 1.366025, 1e-5);
}

TEST_F(DecodeCommand, RefusesWhatDoesNotFitUnlessForced) {
  metadata_.convention = "signed projection";
  const std::string map = sky("signed.exr");
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1"}), 5);
  EXPECT_TRUE(said("signed projection")) << said_;
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1", "--force"}), 0);
  EXPECT_TRUE(said("decoded all the same")) << said_;
}

TEST_F(DecodeCommand, RefusesOtherDirections) {
  std::swap(metadata_.bases[1].direction, metadata_.bases[2].direction);
  EXPECT_EQ(decode({sky("other.exr"), "--normal-vector", "0,0,1"}), 5);
  EXPECT_EQ(decode({path("other.exr"), "--normal-vector", "0,0,1", "--variant", "single"}), 0);
}

TEST_F(DecodeCommand, GreenMustBeSaidForYDownLightmaps) {
  metadata_.green = Green::y_down;
  const std::string map = sky("down.exr");
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1"}), 5);
  EXPECT_TRUE(said("--normal-green")) << said_;
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1", "--flip-green"}), 0) << said_;
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1", "--normal-green", "y-up"}), 0) << said_;
}

TEST_F(DecodeCommand, PlainPicturesAreNotLightmaps) {
  LayeredImage plain;
  plain.layers.push_back({"", {"R", "G", "B"}, filled(4, 4, 3, 1)});
  write_exr(path("plain.exr"), plain, Depth::full);
  EXPECT_EQ(decode({path("plain.exr"), "--normal-vector", "0,0,1"}), 5);
  EXPECT_EQ(decode({path("plain.exr"), "--normal-vector", "0,0,1", "--force"}), 5);  // there are no maps
  EXPECT_EQ(decode({path("plain.exr"), "--normal-vector", "0,0,1", "--force", "--variant", "single"}), 0);
}

TEST_F(DecodeCommand, OfOneLayerOnlyTheFlatBakeIsComplete) {
  for (const LayerFile& file : one_file_per_layer(read_image(sky("sky.exr")))) {
    write_exr(path(file.name + ".exr"), file.image, Depth::full);
    const std::vector<std::string> call{path(file.name + ".exr"), "--normal-vector", "0,0,1"};
    EXPECT_EQ(decode(call), 5);
    EXPECT_TRUE(said("--layout layers")) << said_;
    EXPECT_EQ(decode({call[0], call[1], call[2], "--variant", "single"}), file.name == "flat" ? 0 : 5)
        << said_;
  }
  EXPECT_EQ(result(), 1);
}

TEST_F(DecodeCommand, BadCallsAndFiles) {
  const std::string map = sky("sky.exr");
  EXPECT_EQ(decode({map}), 1);
  EXPECT_EQ(decode({map, "--normal-vector", "0,0"}), 1);
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,0"}), 1);
  EXPECT_EQ(decode({map, "--normal-vector", "0,0,1", "--variant", "best"}), 1);
  EXPECT_EQ(decode({map, "--normal", path("missing.png")}), 2);
  EXPECT_EQ(decode({path("missing.exr"), "--normal-vector", "0,0,1"}), 2);
  write_atomically(path("text.exr"), std::string_view("text"));
  EXPECT_EQ(decode({path("text.exr"), "--normal-vector", "0,0,1"}), 3);
  EXPECT_EQ(std::ranges::count(said_, '\n'), 1) << said_;
}

}  // namespace
}  // namespace rnmbake
