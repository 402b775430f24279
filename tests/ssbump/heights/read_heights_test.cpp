#include "ssbump/heights/read_heights.h"

#include "base/error.h"
#include "base/files.h"
#include "image/picture_rows.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

class Heights : public testing::Test {
 protected:
  std::filesystem::path write(const char* name, std::vector<std::string> channels, Storage storage,
                              const std::vector<float>& values, int width) {
    const auto file = folder_.path() / name;
    const int height = static_cast<int>(values.size() / channels.size()) / width;
    PictureWriter writer(file, {width, height, std::move(channels), storage, {}});
    writer.write(0, height, values);
    writer.commit();
    return file;
  }
  static std::string refusal(const std::filesystem::path& file, const HeightOptions& options, ExitCode code) {
    try {
      (void)read_heights(file, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      return error.what();
    }
    return "was read";
  }
  static HeightOptions channel(const char* name) {
    HeightOptions options;
    options.channel = name;
    return options;
  }

 private:
  TempFolder folder_;
};

TEST_F(Heights, ComeFromTheChannelThatIsNamed) {
  const auto file =
      write("a.png", {"R", "G", "B", "A"}, Storage::u8, {1, 0, 0, 0.2F, 0.6F, 0.6F, 0.6F, 0.4F}, 2);
  HeightOptions options;
  options.texels = 10;
  const auto first = [&](const char* name) {
    options.channel = name;
    return read_heights(file, options).field.heights.texel(0, 0)[0];
  };
  EXPECT_NEAR(first(""), 2.126, 1e-5);
  EXPECT_NEAR(first("luminance"), 2.126, 1e-5);
  for (const char* name : {"R", "r", "red", "0"}) EXPECT_FLOAT_EQ(first(name), 10) << name;
  for (const char* name : {"A", "alpha", "3"}) EXPECT_FLOAT_EQ(first(name), 2) << name;
  EXPECT_EQ(read_heights(file, channel("alpha")).channel, "A");
}

TEST_F(Heights, AreFoundByTheChannelsNames) {
  const auto values = [](std::size_t channels) {
    std::vector<float> list(2 * channels);
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = float(i) / 16;
    return list;
  };
  const auto read = [&](const char* name, const std::vector<std::string>& channels) {
    return read_heights(write(name, channels, Storage::full, values(channels.size()), 2), {}).channel;
  };
  EXPECT_EQ(read("a.exr", {"Y", "A"}), "Y");
  EXPECT_EQ(read("b.exr", {"A", "height"}), "height");
  EXPECT_EQ(read("c.exr", {"R", "G", "B", "A", "Z"}), "luminance");
  EXPECT_EQ(read("d.exr", {"diffuse.R", "diffuse.G", "diffuse.B"}), "luminance");
  for (const std::vector<std::string>& channels :
       {std::vector<std::string>{"X", "Y", "Z"},
        {"height", "mask"},
        {"left.R", "left.G", "left.B", "right.R", "right.G", "right.B"}}) {
    const auto file = write("e.exr", channels, Storage::full, values(channels.size()), 2);
    const std::string said = refusal(file, {}, ExitCode::invalid_input);
    EXPECT_NE(said.find("--channel"), std::string::npos) << said;
    EXPECT_NE(said.find(channels[0].substr(0, 4)), std::string::npos) << said;
    EXPECT_EQ(read_heights(file, channel(channels[1].c_str())).channel, channels[1]);
  }
}

TEST_F(Heights, OfAStripAreThoseOfASquareOfAsManyTexels) {
  const std::vector<float> ramp(64 * 4, 0.5F);
  for (const int width : {4, 16, 64}) {
    const auto file = write("a.tif", {"Y"}, Storage::u16, ramp, width);
    EXPECT_DOUBLE_EQ(read_heights(file, {}).texels, 16 / 32.0) << width;
  }
}

TEST_F(Heights, OfTwelveBitsInSixteenAreSaid) {
  const auto said = [&](float highest, Storage storage, HeightOptions options = {}) {
    const auto file = write("a.tif", {"Y"}, storage, std::vector<float>{0, highest}, 2);
    testing::internal::CaptureStderr();
    (void)read_heights(file, options);
    return testing::internal::GetCapturedStderr();
  };
  const std::string twelve = said(4095 / 65535.0F, Storage::u16);
  EXPECT_NE(twelve.find("no value above 4095 of 65535, as of 12 bits"), std::string::npos) << twelve;
  EXPECT_NE(twelve.find("--height 0.7073 "), std::string::npos) << "sqrt(2) / 32 x 65535 / 4095: " << twelve;
  EXPECT_NE(said(1023 / 65535.0F, Storage::u16).find("as of 10 bits"), std::string::npos);
  EXPECT_EQ(said(4096 / 65535.0F, Storage::u16), "");
  EXPECT_EQ(said(4095 / 65535.0F, Storage::full), "");
  HeightOptions chosen;
  chosen.texels = 3;
  EXPECT_EQ(said(4095 / 65535.0F, Storage::u16, chosen), "");
}

TEST_F(Heights, OfFloatsAreTexelsAndOfIntegersAShareOfTheSize) {
  const std::vector<float> ramp{0, 0.25F, 0.5F, 1};
  const auto floats = write("a.exr", {"Y"}, Storage::full, ramp, 4);
  const auto integers = write("a.tif", {"Y"}, Storage::u16, ramp, 4);
  EXPECT_FLOAT_EQ(read_heights(floats, {}).field.heights.texel(3, 0)[0], 1);
  EXPECT_FLOAT_EQ(read_heights(integers, {}).field.heights.texel(3, 0)[0], 2.0F / 32);
  HeightOptions options;
  options.invert = true;
  options.texels = 8;
  EXPECT_FLOAT_EQ(read_heights(integers, options).field.heights.texel(0, 0)[0], 8);
  EXPECT_FLOAT_EQ(read_heights(floats, options).field.heights.texel(3, 0)[0], 0);
}

TEST_F(Heights, NamesTheTexelWithoutAHeight) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const auto one = write("a.exr", {"Y"}, Storage::full, {0, 1, 2, 3, nan, 5}, 3);
  const auto two = write("b.exr", {"Y"}, Storage::half, {0, 1, 2, 3, 5, -inf}, 3);
  EXPECT_NE(refusal(one, {}, ExitCode::invalid_input).find("texel (1, 1) from the top left is NaN"),
            std::string::npos);
  EXPECT_NE(refusal(two, {}, ExitCode::invalid_input).find("texel (2, 1) from the top left is infinite"),
            std::string::npos);
}

TEST_F(Heights, NamesTheChannelsThatThereAre) {
  const auto colour = write("a.png", {"R", "G", "B"}, Storage::u8, {0, 0, 0}, 1);
  EXPECT_NE(refusal(colour, channel("alpha"), ExitCode::usage).find("its channels are R, G, B (or 0 to 2)"),
            std::string::npos);
  EXPECT_NE(refusal(colour, channel("3"), ExitCode::usage).find("no channel '3'"), std::string::npos);
  const auto named = write("b.exr", {"height", "mask"}, Storage::half, {0, 1}, 1);
  EXPECT_NE(refusal(named, channel("heigth"), ExitCode::usage).find("did you mean 'height'?"),
            std::string::npos);
}

TEST_F(Heights, RefusesHeightsThatNothingCanBe) {
  const auto depth = write("a.exr", {"Z"}, Storage::full, {1, 1e10F}, 2);
  EXPECT_NE(refusal(depth, {}, ExitCode::invalid_input).find("range over 1e+10 texels"), std::string::npos);
  EXPECT_NE(refusal("none.png", {}, ExitCode::io).find("none.png"), std::string::npos);
}

}  // namespace
}  // namespace rnmbake
