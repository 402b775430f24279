#include "pipeline/convert/convert.h"

#include "base/error.h"
#include "base/files.h"
#include "image/layered_exr.h"
#include "lightmap/decode.h"
#include "lightmap/metadata.h"
#include "sampling/splitmix64.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int map_width = 23, map_height = 150;  // more than two bands of rows

/// A few suns over a sky: bakes that light can have.
std::array<float, 4> bakes_of_suns(SplitMix64& random) {
  std::array<float, 4> bakes{};
  const auto basis = rnm_set().directions;
  const auto light = [&](const Vec3& direction, float strength) {
    bakes[0] += strength * direction.z;
    for (std::size_t i = 0; i < 3; ++i)
      bakes[i + 1] += strength * std::max(0.0F, direction.dot(basis[i].direction));
  };
  for (std::size_t i = 0; i < 4; ++i) bakes[i] = i == 0 ? 1.0F : 0.5F * (1 + basis[i - 1].direction.z);
  for (int sun = 0; sun < 3; ++sun) {
    const float z = float(random.next_double()), azimuth = 6.2831853F * float(random.next_double()),
                r = std::sqrt(1 - z * z);
    light({r * std::cos(azimuth), r * std::sin(azimuth), z}, float(random.next_double()));
  }
  return bakes;
}

LightmapMetadata baked_metadata() {
  LightmapMetadata metadata;
  metadata.bases = flat_and_rnm().directions;
  metadata.object = "floor";
  return metadata;
}

/// Random frames, every fifth column uncovered and without one.
LayeredImage baked(Green green = Green::y_up) {
  SplitMix64 random(7);
  LayeredImage image;
  for (const char* name : {"", "rnm0", "rnm1", "rnm2"})
    image.layers.push_back({name, {"R", "G", "B"}, FloatImage(map_width, map_height, 3)});
  image.layers.push_back({"tangent", {"X", "Y", "Z", "S"}, FloatImage(map_width, map_height, 4)});
  image.layers.push_back({"normal", {"X", "Y", "Z"}, FloatImage(map_width, map_height, 3)});
  image.layers.push_back({"coverage", {""}, FloatImage(map_width, map_height, 1)});
  for (int y = 0; y < map_height; ++y) {
    for (int x = 0; x < map_width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const auto bakes = bakes_of_suns(random);
        for (std::size_t i = 0; i < 4; ++i) image.layers[i].pixels.texel(x, y)[std::size_t(c)] = bakes[i];
      }
      if (x % 5 == 4) continue;
      const Vec3 n = unit(Vec3(float(random.next_double()) - 0.5F, float(random.next_double()) - 0.5F,
                               float(random.next_double()) + 0.1F));
      const Vec3 t = unit(n.cross(Vec3(0.3F, 0.9F, 0.1F)));
      std::ranges::copy(std::array{t.x, t.y, t.z, y % 2 == 0 ? 1.0F : -1.0F},
                        image.layers[4].pixels.texel(x, y).begin());
      std::ranges::copy(std::array{n.x, n.y, n.z}, image.layers[5].pixels.texel(x, y).begin());
      image.layers[6].pixels.texel(x, y)[0] = 1;
    }
  }
  LightmapMetadata metadata = baked_metadata();
  metadata.green = green;
  write_metadata(metadata, image);
  return image;
}

class Convert : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }

  [[nodiscard]] std::filesystem::path written(const std::string& name, const LayeredImage& image) const {
    write_exr(at(name), image, Depth::full);
    return at(name);
  }

  ConvertSummary convert(const std::filesystem::path& from, const std::string& encoding,
                         const std::string& to, bool world = false) const {
    return convert_lightmap({"floor", {from}, {}}, {{encoding}, world, Depth::full}, at(to));
  }

  void expect_refused(ExitCode code, const std::string& words, const std::function<void()>& work) const {
    try {
      work();
      FAIL() << "was converted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(at("out.exr")));
  }

  /// Greatest difference between the four bakes of two files, as a share of the greatest value.
  [[nodiscard]] double bakes_apart(const std::filesystem::path& a, const std::filesystem::path& b,
                                   bool covered_only = false) const {
    const LayeredImage one = read_image(a), other = read_image(b);
    const FloatImage& coverage = one.find("coverage")->pixels;
    double apart = 0, greatest = 0;
    for (const char* name : {"", "rnm0", "rnm1", "rnm2"}) {
      const FloatImage &p = one.find(name)->pixels, &q = other.find(name)->pixels;
      for (std::size_t i = 0; i < p.data().size(); ++i) {
        if (covered_only && coverage.data()[i / 3] < 0.5F) continue;
        apart = std::max(apart, std::abs(double(p.data()[i]) - q.data()[i]));
        greatest = std::max(greatest, std::abs(double(p.data()[i])));
      }
    }
    return apart / greatest;
  }

  TempFolder folder_;
};

constexpr double few_roundings = 32 * std::numeric_limits<float>::epsilon();
constexpr double solved = 2e-6;  // what a refit calls solved, and its rounding to floats

TEST_F(Convert, ReturnsTheBakesFromWhereverTheyWent) {
  const auto source = written("baked.exr", baked());
  for (const auto& [encoding, bound] :
       {std::pair{"sh2", few_roundings}, {"zh3", solved}, {"geomerics", solved}}) {
    const ConvertSummary summary = convert(source, encoding, "there.exr");
    EXPECT_EQ(summary.counts.encode.texels, std::size_t(map_height) * (map_width - map_width / 5))
        << encoding;
    (void)convert(at("there.exr"), "rnm", "back.exr");
    if (summary.counts.encode.unconverged == 0) {
      EXPECT_LT(bakes_apart(source, at("back.exr")), bound) << encoding;
    }
    EXPECT_LE(summary.counts.encode.unconverged, summary.counts.encode.texels / 100) << encoding;
  }
}

TEST_F(Convert, ReturnsFromWorldSpace) {
  for (const Green green : {Green::y_up, Green::y_down}) {
    const auto source = written("baked.exr", baked(green));
    EXPECT_EQ(convert(source, "sh2", "world.exr", true).counts.without_frame, 0U);
    (void)convert(at("world.exr"), "rnm", "back.exr");
    EXPECT_LT(bakes_apart(source, at("back.exr"), true), 4 * few_roundings);
    (void)convert(source, "sh2", "tangent.exr");
    const LayeredImage there = read_image(at("world.exr")), here = read_image(at("tangent.exr"));
    EXPECT_EQ(there.find("l0")->pixels.texel(0, 0)[0], here.find("l0")->pixels.texel(0, 0)[0]);
    EXPECT_NE(there.find("l1x")->pixels.texel(0, 0)[0], here.find("l1x")->pixels.texel(0, 0)[0]);
  }
}

TEST_F(Convert, DecodesAsTheBakesWherever) {
  const auto source = written("baked.exr", baked(Green::y_down));
  const LayeredImage image = read_image(source);
  for (const bool world : {false, true}) {
    (void)convert(source, "sh2", "there.exr", world);
    const LayeredImage there = read_image(at("there.exr"));
    const LightmapMetadata metadata = read_metadata(there, "there.exr");
    EXPECT_EQ(metadata.space, world ? "world" : "tangent");
    EXPECT_EQ(decode_obstacle(metadata, natural_variant(metadata)), std::nullopt);
    EXPECT_NE(decode_obstacle(metadata, DecodeVariant::squared), std::nullopt);
    const LightmapDecoder decoder(lightmap_of(there, metadata), DecodeVariant::encoded);
    for (const auto& [name, direction] : metadata.bases) {
      const FloatImage& bake = image.find(name == "flat" ? "" : name)->pixels;
      const Vec3 decoded = decoder.at(texel_uv(bake, 7, 80), direction, Green::y_down);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(decoded[c], bake.texel(7, 80)[std::size_t(c)], 1e-5) << name << " " << world;
    }
  }
}

/// Dilated texels have no frame of their own and take the nearest, whichever band of rows it is in.
TEST_F(Convert, GivesTexelsBesideACoveredOneItsFrame) {
  LayeredImage image = baked();
  for (const std::size_t layer : {4U, 5U})  // a strip across the border of two bands
    for (int y = 60; y < 66; ++y) std::ranges::fill(image.layers[layer].pixels.texel(7, y), 0.0F);
  (void)convert(written("baked.exr", image), "sh2", "world.exr", true);
  const LayeredImage world = read_image(at("world.exr"));
  for (const int y : {62, 63, 64}) {
    const Vec3 v(world.find("l1x")->pixels.texel(7, y)[0], world.find("l1y")->pixels.texel(7, y)[0],
                 world.find("l1z")->pixels.texel(7, y)[0]);
    EXPECT_GT(v.length(), 0.01F) << y;
  }
}

TEST_F(Convert, LeavesOtherLayersAsTheyAre) {
  const auto source = written("baked.exr", baked());
  (void)convert(source, "zh3", "there.exr");
  const LayeredImage from = read_image(source), to = read_image(at("there.exr"));
  for (const char* name : {"coverage", "tangent", "normal"})
    EXPECT_EQ(from.find(name)->pixels.data(), to.find(name)->pixels.data()) << name;
  EXPECT_EQ(to.find("rnm0"), nullptr);
  EXPECT_EQ(std::get<std::string>(to.attributes.at("rnmbake:convention")), "zh3");
  EXPECT_EQ(std::get<std::string>(to.attributes.at("rnmbake:object")), "floor");
}

/// Split or not, the same numbers; and what was split is read again as one lightmap.
TEST_F(Convert, SplitsIntoOneFileForEachLayer) {
  const auto source = written("baked.exr", baked());
  (void)convert(source, "sh2", "whole.exr");
  const ConvertSummary split =
      convert_lightmap({"floor", {source}, {}}, {{"sh2"}, false, Depth::full, true}, at("split.exr"));
  std::vector<std::string> names;
  for (const auto& file : split.files) names.push_back(file.filename().string());
  EXPECT_EQ(names,
            (std::vector<std::string>{"split.l0.exr", "split.l1x.exr", "split.l1y.exr", "split.l1z.exr",
                                      "split.coverage.exr", "split.normal.exr", "split.tangent.exr"}));
  const LightmapPlace place{"floor", split.files, {}};
  const LoadedLightmap parts = load_lightmap(place);
  EXPECT_EQ(parts.metadata.convention, "sh2");
  const LayeredImage whole = read_image(at("whole.exr"));
  for (const Layer& layer : whole.layers)
    EXPECT_EQ(parts.image.find(layer.name)->pixels.data(), layer.pixels.data());
  (void)convert_lightmap(place, {{"rnm"}, false, Depth::full}, at("back.exr"));
  EXPECT_LT(bakes_apart(source, at("back.exr")), few_roundings);
}

TEST_F(Convert, GivesTheSameBytesWhateverTheThreads) {
  const LightmapPlace place{"floor", {written("baked.exr", baked())}, {}};
  for (const CodecOptions& codec :
       {CodecOptions{"zh3"}, {"geomerics"}, {"zh3", 2, 8}, {"geomerics", 2, 16, true}, {"ahd"}}) {
    for (const int threads : {1, 2}) {
      const auto file = at(threads == 1 ? "one.exr" : "two.exr");
      tbb::task_arena(threads).execute([&] { (void)convert_lightmap(place, {codec}, file); });
    }
    EXPECT_EQ(read_text(at("one.exr")), read_text(at("two.exr"))) << codec.name << ' ' << codec.range;
  }
}

TEST_F(Convert, WritesDarknessForWhatIsNoNumber) {
  LayeredImage image = baked();
  image.layers[1].pixels.texel(0, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  const ConvertSummary summary = convert(written("baked.exr", image), "zh3", "there.exr");
  EXPECT_EQ(summary.counts.encode.non_finite, 1U);
  const LayeredImage there = read_image(at("there.exr"));
  for (const Layer& layer : there.layers)
    for (const float value : layer.pixels.data()) ASSERT_TRUE(std::isfinite(value)) << layer.name;
}

TEST_F(Convert, RefusesWhatCannotBeTurned) {
  const auto changed = [&](const std::function<void(LightmapMetadata&)>& change) {
    LayeredImage image = baked();
    LightmapMetadata metadata = baked_metadata();
    change(metadata);
    write_metadata(metadata, image);
    return written("changed.exr", image);
  };
  const auto to = [&](const std::filesystem::path& from, const char* encoding, bool world = false) {
    return [&, from, encoding, world] { (void)convert(from, encoding, "out.exr", world); };
  };
  expect_refused(ExitCode::unsupported, "convention is 'vrad'",
                 to(changed([](auto& m) { m.convention = "vrad"; }), "sh2"));
  expect_refused(ExitCode::unsupported, "units are 'E'", to(changed([](auto& m) { m.units = "E"; }), "sh2"));
  expect_refused(ExitCode::unsupported, "scaled to the flat bake",
                 to(changed([](auto& m) { m.normalize = Normalize::flat; }), "sh2"));
  expect_refused(ExitCode::unsupported, "tangent space only", to(written("baked.exr", baked()), "rnm", true));
  LayeredImage bare = baked();
  std::erase_if(bare.layers, [](const Layer& layer) { return layer.name == "tangent"; });
  expect_refused(ExitCode::unsupported, "--frames", to(written("bare.exr", bare), "sh2", true));
  (void)convert(at("baked.exr"), "flat", "flat.exr");
  expect_refused(ExitCode::unsupported, "does not keep what was baked", to(at("flat.exr"), "sh2"));
  expect_refused(ExitCode::usage, "no encoding 'sh9'", to(at("baked.exr"), "sh9"));
  LayeredImage two = baked();
  LightmapMetadata only_flat = baked_metadata();
  only_flat.bases.resize(1);
  std::erase_if(two.layers, [](const Layer& layer) { return layer.name.starts_with("rnm"); });
  two.attributes.clear();
  write_metadata(only_flat, two);
  expect_refused(ExitCode::unsupported, "needs the bake 'rnm0'", to(written("two.exr", two), "zh3"));
}

TEST_F(Convert, RefusesDamagedFiles) {
  const auto source = written("baked.exr", baked());
  const std::string bytes = read_text(source);
  write_atomically(at("cut.exr"), bytes.substr(0, bytes.size() / 2));
  expect_refused(ExitCode::invalid_input, "cut.exr", [&] { (void)convert(at("cut.exr"), "sh2", "out.exr"); });
  LayeredImage small = baked();
  for (Layer& layer : small.layers) layer.pixels = FloatImage(4, 4, layer.pixels.channels());
  (void)written("small.exr", small);
  expect_refused(ExitCode::invalid_input, "differ in size", [&] {
    (void)convert_lightmap({"floor", {source, at("small.exr")}, {}}, {{"sh2"}, false, Depth::full},
                           at("out.exr"));
  });
}

TEST_F(Convert, FolderKeepsItsManifest) {
  make_folders(at("in"));
  (void)written("in/floor.exr", baked());
  write_atomically(at("in/manifest.json"),
                   R"({"schema_version": 1, "conventions": {"encoding": "clipped hemisphere integral"},
                       "objects": [{"key": "floor", "files": ["floor.exr"], "status": "baked"},
                                   {"key": "lost", "files": [], "status": "failed"}]})");
  const auto summaries = convert_lightmaps(at("in"), {{"zh3"}, true, Depth::half}, at("out"));
  ASSERT_EQ(summaries.size(), 1U);
  EXPECT_EQ(summaries.front().key, "floor");
  const LightmapFolder folder = open_lightmaps(at("out"));
  ASSERT_EQ(folder.places.size(), 1U);
  EXPECT_EQ(folder.failed, std::vector<std::string>{"lost"});
  EXPECT_EQ(load_lightmap(folder.places.front()).metadata.convention, "zh3");
  expect_refused(ExitCode::usage, "name another folder", [&] {
    (void)convert_lightmaps(at("in"), {{"zh3"}, false, Depth::half}, at("in"));
  });
}

}  // namespace
}  // namespace rnmbake
