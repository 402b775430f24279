#include "pipeline/decode/decode_rows.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/encodings.h"
#include "image/display_png.h"
#include "image/layered_exr.h"
#include "pipeline/decode/lit_writer.h"
#include "sampling/splitmix64.h"
#include "support/pictures.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr int lit_width = 23, lit_height = 150;  // more than two bands of rows

FloatImage noise(int channels, std::uint64_t seed, float least, float greatest) {
  SplitMix64 random(seed);
  FloatImage image(lit_width, lit_height, channels);
  for (float& value : image.data()) value = least + (greatest - least) * float(random.next_double());
  return image;
}

class DecodeRows : public testing::Test {
 protected:
  DecodeRows() {
    metadata_.bases = flat_and_rnm().directions;
    LayeredImage image;
    std::uint64_t seed = 1;
    for (const char* name : {"", "rnm0", "rnm1", "rnm2"})
      image.layers.push_back({name, {"R", "G", "B"}, noise(3, seed++, 0.1F, 2)});
    FloatImage coverage = noise(1, seed, 0, 1);
    for (float& value : coverage.data()) value = value > 0.3F ? 1 : 0;
    image.layers.push_back({"coverage", {""}, std::move(coverage)});
    write_exr(path("map.exr"), image, Depth::full);
  }

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

  [[nodiscard]] Lightmap whole() const { return lightmap_of(read_image(path("map.exr")), metadata_); }

  /// Writes the normals, decodes by rows; compared with the decode of both as a whole.
  void expect_same_with(const FloatImage& normals, const std::string& file) {
    LayeredImage picture;
    picture.layers.push_back({"", {"R", "G", "B"}, normals});
    write_exr(path(file), picture, Depth::full);
    const NormalPicture all{normals_of(read_image(path(file)), file), Green::y_down};
    const FloatImage expected = decode(whole(), all, DecodeVariant::squared);
    LayerRows rows(path("map.exr"));
    NormalRows normal_rows(path(file));
    decode_rows(rows, metadata_, normal_rows, Green::y_down, DecodeVariant::squared, joined());
    EXPECT_EQ(lit_.data(), expected.data()) << file;
  }

  /// Rows go into `lit_`, and follow each other without a gap.
  [[nodiscard]] TakeRows joined() {
    lit_ = filled(lit_width, lit_height, 3, -1);
    last_ = 0;
    return [this](int begin, int end, FloatImage&& rows) {
      EXPECT_EQ(begin, last_);
      last_ = end;
      EXPECT_LE(rows.height(), LayerRows::band);
      std::ranges::copy(rows.data(), lit_.texel(0, begin).data());
    };
  }

  TempFolder folder_;
  LightmapMetadata metadata_;
  FloatImage lit_;
  int last_ = 0;
};

TEST_F(DecodeRows, OneNormalIsThatOfTheWholeLightmap) {
  const Vec3 normal = Vec3(0.3F, -0.2F, 0.8F);
  for (const auto variant :
       {DecodeVariant::squared, DecodeVariant::linear, DecodeVariant::vrad, DecodeVariant::single}) {
    LayerRows rows(path("map.exr"));
    decode_rows(rows, metadata_, normal, Green::y_up, variant, joined());
    EXPECT_EQ(lit_.data(), decode(whole(), normal, Green::y_up, variant).data()) << name_of(variant);
  }
}

TEST_F(DecodeRows, NormalMapIsThatOfTheWholeLightmap) {
  expect_same_with(noise(3, 8, 0.2F, 0.9F), "unsigned.exr");
  expect_same_with(noise(3, 9, -0.5F, 0.9F), "signed.exr");
}

/// The first rows of a picture of vectors may look like colours.
TEST_F(DecodeRows, NegativeValueInTheLastRowMakesAllRowsVectors) {
  FloatImage normals = noise(3, 10, 0.1F, 0.9F);
  FloatImage with_negative = normals;
  with_negative.texel(lit_width - 1, lit_height - 1)[0] = -0.5F;
  expect_same_with(normals, "colours.exr");
  const FloatImage as_colours = lit_;
  expect_same_with(with_negative, "vectors.exr");
  EXPECT_GT(largest_difference(lit_, as_colours), 0.1);
}

TEST_F(DecodeRows, PngIsTheOneToLookAt) {
  const FloatImage lit = noise(3, 11, -0.2F, 1.5F);
  write_display_png(path("whole.png"), lit, -0.5F);
  LitWriter writer(path("rows.png"), lit_width, lit_height, "squared", -0.5F);
  for (int begin = 0; begin < lit_height; begin += 64) {
    const int end = std::min(begin + 64, lit_height);
    FloatImage rows(lit_width, end - begin, 3);
    std::copy_n(lit.texel(0, begin).data(), rows.data().size(), rows.data().data());
    writer.write(begin, end, std::move(rows));
  }
  writer.commit();
  const LayeredImage whole = read_image(path("whole.png")), rows = read_image(path("rows.png"));
  EXPECT_EQ(rows.layers.front().pixels.data(), whole.layers.front().pixels.data());
  EXPECT_EQ(rows.attributes, whole.attributes);
}

TEST_F(DecodeRows, NothingAppearsWhereTheLightmapEndsEarly) {
  std::filesystem::resize_file(path("map.exr"), std::filesystem::file_size(path("map.exr")) * 2 / 3);
  const auto lit = path("lit.exr");
  EXPECT_THROW(
      {
        LayerRows rows(path("map.exr"));
        LitWriter writer(lit, lit_width, lit_height, "squared", 0);
        decode_rows(
            rows, metadata_, Vec3(0, 0, 1), Green::y_up, DecodeVariant::squared,
            [&](int begin, int end, FloatImage&& band) { writer.write(begin, end, std::move(band)); });
        writer.commit();
      },
      Error);
  EXPECT_FALSE(std::filesystem::exists(lit));
}

}  // namespace
}  // namespace rnmbake
