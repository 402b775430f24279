// Textures other than our own: PNG, JPEG, and what their readers do to values.
#include "base/error.h"
#include "base/files.h"
#include "image/display_png.h"
#include "image/layered_exr.h"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

// 2x2 RGBA, 8 bits: (255,0,0,0) (128,128,255,128) / (0,255,0,255) (10,20,30,1)
const std::array<unsigned char, 83> rgba_png{
    137, 80, 78,  71,  13,  10,  26,  10,  0,   0,   0,   13,  73,  72, 68,  82,  0,   0,  0,  2,  0,
    0,   0,  2,   8,   6,   0,   0,   0,   114, 182, 13,  36,  0,   0,  0,   26,  73,  68, 65, 84, 120,
    218, 99, 248, 207, 192, 192, 208, 208, 240, 191, 129, 129, 225, 63, 195, 127, 46,  17, 57, 70, 0,
    58,  11, 5,   186, 221, 21,  45,  246, 0,   0,   0,   0,   73,  69, 78,  68,  174, 66, 96, 130};

// 8x8 grey ramp as JPEG.
const std::array<unsigned char, 755> jpeg{
    255, 216, 255, 224, 0,   16,  74,  70,  73,  70,  0,   1,   1,   0,   0,   1,   0,   1,   0,   0,   255,
    225, 1,   24,  69,  120, 105, 102, 0,   0,   73,  73,  42,  0,   188, 0,   0,   0,   111, 105, 105, 111,
    116, 111, 111, 108, 32,  47,  116, 109, 112, 47,  114, 97,  109, 112, 46,  112, 103, 109, 32,  45,  45,
    99,  111, 109, 112, 114, 101, 115, 115, 105, 111, 110, 32,  106, 112, 101, 103, 58,  54,  48,  32,  45,
    45,  101, 114, 97,  115, 101, 97,  116, 116, 114, 105, 98,  32,  46,  42,  32,  45,  111, 32,  47,  116,
    109, 112, 47,  114, 97,  109, 112, 46,  106, 112, 103, 0,   79,  112, 101, 110, 73,  109, 97,  103, 101,
    73,  79,  32,  50,  46,  52,  46,  55,  46,  49,  32,  58,  32,  111, 105, 105, 111, 116, 111, 111, 108,
    32,  47,  116, 109, 112, 47,  114, 97,  109, 112, 46,  112, 103, 109, 32,  45,  45,  99,  111, 109, 112,
    114, 101, 115, 115, 105, 111, 110, 32,  106, 112, 101, 103, 58,  54,  48,  32,  45,  45,  101, 114, 97,
    115, 101, 97,  116, 116, 114, 105, 98,  32,  46,  42,  32,  45,  111, 32,  47,  116, 109, 112, 47,  114,
    97,  109, 112, 46,  106, 112, 103, 0,   2,   0,   49,  1,   2,   0,   101, 0,   0,   0,   87,  0,   0,
    0,   105, 135, 4,   0,   1,   0,   0,   0,   218, 0,   0,   0,   0,   0,   0,   0,   4,   0,   0,   144,
    7,   0,   4,   0,   0,   0,   48,  50,  51,  48,  1,   145, 7,   0,   4,   0,   0,   0,   1,   2,   3,
    0,   19,  146, 2,   0,   79,  0,   0,   0,   8,   0,   0,   0,   0,   160, 7,   0,   4,   0,   0,   0,
    48,  49,  48,  48,  0,   0,   0,   0,   255, 237, 0,   133, 80,  104, 111, 116, 111, 115, 104, 111, 112,
    32,  51,  46,  48,  0,   56,  66,  73,  77,  4,   4,   0,   0,   0,   0,   0,   105, 28,  2,   65,  0,
    100, 79,  112, 101, 110, 73,  109, 97,  103, 101, 73,  79,  32,  50,  46,  52,  46,  55,  46,  49,  32,
    58,  32,  111, 105, 105, 111, 116, 111, 111, 108, 32,  47,  116, 109, 112, 47,  114, 97,  109, 112, 46,
    112, 103, 109, 32,  45,  45,  99,  111, 109, 112, 114, 101, 115, 115, 105, 111, 110, 32,  106, 112, 101,
    103, 58,  54,  48,  32,  45,  45,  101, 114, 97,  115, 101, 97,  116, 116, 114, 105, 98,  32,  46,  42,
    32,  45,  111, 32,  47,  116, 109, 112, 47,  114, 97,  109, 112, 46,  106, 112, 103, 255, 219, 0,   67,
    0,   13,  9,   10,  11,  10,  8,   13,  11,  10,  11,  14,  14,  13,  15,  19,  32,  21,  19,  18,  18,
    19,  39,  28,  30,  23,  32,  46,  41,  49,  48,  46,  41,  45,  44,  51,  58,  74,  62,  51,  54,  70,
    55,  44,  45,  64,  87,  65,  70,  76,  78,  82,  83,  82,  50,  62,  90,  97,  90,  80,  96,  74,  81,
    82,  79,  255, 192, 0,   11,  8,   0,   8,   0,   8,   1,   1,   17,  0,   255, 196, 0,   31,  0,   0,
    1,   5,   1,   1,   1,   1,   1,   1,   0,   0,   0,   0,   0,   0,   0,   0,   1,   2,   3,   4,   5,
    6,   7,   8,   9,   10,  11,  255, 196, 0,   181, 16,  0,   2,   1,   3,   3,   2,   4,   3,   5,   5,
    4,   4,   0,   0,   1,   125, 1,   2,   3,   0,   4,   17,  5,   18,  33,  49,  65,  6,   19,  81,  97,
    7,   34,  113, 20,  50,  129, 145, 161, 8,   35,  66,  177, 193, 21,  82,  209, 240, 36,  51,  98,  114,
    130, 9,   10,  22,  23,  24,  25,  26,  37,  38,  39,  40,  41,  42,  52,  53,  54,  55,  56,  57,  58,
    67,  68,  69,  70,  71,  72,  73,  74,  83,  84,  85,  86,  87,  88,  89,  90,  99,  100, 101, 102, 103,
    104, 105, 106, 115, 116, 117, 118, 119, 120, 121, 122, 131, 132, 133, 134, 135, 136, 137, 138, 146, 147,
    148, 149, 150, 151, 152, 153, 154, 162, 163, 164, 165, 166, 167, 168, 169, 170, 178, 179, 180, 181, 182,
    183, 184, 185, 186, 194, 195, 196, 197, 198, 199, 200, 201, 202, 210, 211, 212, 213, 214, 215, 216, 217,
    218, 225, 226, 227, 228, 229, 230, 231, 232, 233, 234, 241, 242, 243, 244, 245, 246, 247, 248, 249, 250,
    255, 218, 0,   8,   1,   1,   0,   0,   63,  0,   175, 224, 40,  191, 213, 241, 233, 95,  255, 217};

template <std::size_t N>
std::filesystem::path stored(const TempFolder& folder, const char* name,
                             const std::array<unsigned char, N>& bytes, std::size_t count = N) {
  const auto file = folder.path() / name;
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(count));
  return file;
}

TEST(Textures, AlphaOfAPngDoesNotChangeItsColours) {
  const TempFolder folder;
  const LayeredImage image = read_image(stored(folder, "n.png", rgba_png));
  const Layer* layer = image.find("");
  ASSERT_NE(layer, nullptr);
  EXPECT_EQ(layer->channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  const auto at = [&](int x, int y, std::size_t c) { return 255 * layer->pixels.texel(x, y)[c]; };
  EXPECT_NEAR(at(0, 0, 0), 255, 1e-3);
  EXPECT_NEAR(at(0, 0, 3), 0, 1e-3);
  EXPECT_NEAR(at(1, 0, 0), 128, 1e-3);  // no sRGB curve either
  EXPECT_NEAR(at(1, 0, 2), 255, 1e-3);
  EXPECT_NEAR(at(0, 1, 1), 255, 1e-3);
  EXPECT_NEAR(at(1, 1, 2), 30, 1e-3);
}

TEST(Textures, AlphaComesBehindVectorsToo) {
  const TempFolder folder;
  LayeredImage image;
  image.layers.push_back({"", {"X", "Y", "Z", "A"}, FloatImage(1, 1, 4)});
  image.layers[0].pixels.data() = {0.6F, 0, 0.8F, 1};
  write_exr(folder.path() / "n.exr", image, Depth::full);
  const LayeredImage read = read_image(folder.path() / "n.exr");
  EXPECT_EQ(read.layers[0].channels, (std::vector<std::string>{"X", "Y", "Z", "A"}));
  EXPECT_EQ(read.layers[0].pixels.data(), image.layers[0].pixels.data());
}

TEST(Textures, TruncatedPngAndJpegAreRefused) {
  const TempFolder folder;
  EXPECT_NO_THROW((void)read_image(stored(folder, "whole.jpg", jpeg)));
  EXPECT_THROW((void)read_image(stored(folder, "cut.png", rgba_png, 60)), Error);
  EXPECT_THROW((void)read_image(stored(folder, "cut.jpg", jpeg, jpeg.size() - 30)), Error);
}

TEST(Textures, SrgbCurve) {
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_NEAR(srgb_encode(1), 1, 1e-6);
  EXPECT_NEAR(srgb_encode(0.0031308F), 0.04045, 1e-5);
  EXPECT_NEAR(srgb_encode(0.214041F), 0.5, 1e-5);
  EXPECT_EQ(srgb_encode(-1), 0);
  EXPECT_NEAR(srgb_encode(1e9F), 1, 1e-6);
  EXPECT_EQ(srgb_encode(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Textures, DisplayPngIsExposedClampedAndEncoded) {
  const TempFolder folder;
  FloatImage image(2, 1, 3);
  image.data() = {0.1070205F, 0, 0.5F, 7, -1, 0.25F};
  write_display_png(folder.path() / "p.png", image, 1);
  const LayeredImage read = read_image(folder.path() / "p.png");
  const auto& values = read.find("")->pixels.data();
  EXPECT_NEAR(values[0], 0.5, 0.5 / 255 + 1e-6);
  EXPECT_EQ(values[1], 0);
  EXPECT_EQ(values[2], 1);
  EXPECT_EQ(values[3], 1);
  EXPECT_EQ(values[4], 0);
  EXPECT_NEAR(values[5], srgb_encode(0.5F), 0.5 / 255 + 1e-6);
}

}  // namespace
}  // namespace rnmbake
