#include "image/vtf.h"

#include "base/bytes.h"

#include <cstdint>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

template <typename T>
T at(const std::string& file, std::size_t place) {
  T value{};
  EXPECT_TRUE(ByteReader(std::string_view(file).substr(place)).take(value));
  return value;
}

/// Places of a header of version 7.2, as "VTF (Valve Texture Format)" lists its fields.
TEST(Vtf, HeaderSaysWhatFollows) {
  const std::string texels(8 * 4 * 2, 'x');
  const std::string file = vtf_of({4, 2, texels, {0.25F, 0.5F, 1}});
  EXPECT_EQ(file.substr(0, 4), std::string("VTF\0", 4));
  EXPECT_EQ(at<std::uint32_t>(file, 4), 7U);
  EXPECT_EQ(at<std::uint32_t>(file, 8), 2U);
  EXPECT_EQ(at<std::uint32_t>(file, 12), 80U);
  EXPECT_EQ(at<std::uint16_t>(file, 16), 4);
  EXPECT_EQ(at<std::uint16_t>(file, 18), 2);
  EXPECT_EQ(at<std::uint32_t>(file, 20), 0x30CU);  // clamped both ways, no mipmaps, no levels of detail
  EXPECT_EQ(at<std::uint16_t>(file, 24), 1);
  EXPECT_EQ(at<float>(file, 32), 0.25F);
  EXPECT_EQ(at<float>(file, 40), 1.0F);
  EXPECT_EQ(at<float>(file, 48), 1.0F);
  EXPECT_EQ(at<std::uint32_t>(file, 52), 24U);  // RGBA16161616F
  EXPECT_EQ(at<std::uint8_t>(file, 56), 1);
  EXPECT_EQ(at<std::uint32_t>(file, 57), 0xFFFFFFFFU);
  EXPECT_EQ(at<std::uint16_t>(file, 61), 0);
  EXPECT_EQ(at<std::uint16_t>(file, 63), 1);
  EXPECT_EQ(file.substr(80), texels);
  EXPECT_EQ(file.size(), vtf_size(4, 2));
}

}  // namespace
}  // namespace rnmbake
