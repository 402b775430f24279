#include "pipeline/compare/compare.h"

#include "base/error.h"
#include "base/files.h"
#include "image/layered_exr.h"
#include "lightmap/layout.h"
#include "lightmap/metadata.h"
#include "report/write.h"
#include "support/pictures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

constexpr int picture_size = 16;

struct WrittenLightmap {
  std::string key;
  float value = 1;
  int seed = 1, size = picture_size;
  std::vector<std::string> bases{"flat", "rnm0", "rnm1", "rnm2"};
  float standard_error = 0;
  std::function<void(LightmapMetadata&)> change = {};
  std::function<void(LayeredImage&)> spoil = {};
};

LayeredImage lightmap_of(const WrittenLightmap& wanted) {
  LightmapMetadata metadata;
  metadata.bases = flat_and_rnm().directions;
  std::erase_if(metadata.bases,
                [&](const auto& basis) { return std::ranges::count(wanted.bases, basis.name) == 0; });
  metadata.seed = wanted.seed;
  metadata.object = wanted.key;
  if (wanted.change) wanted.change(metadata);
  LayeredImage image;
  for (const std::string& basis : wanted.bases) {
    image.layers.push_back(
        {basis == "flat" ? "" : basis, {"R", "G", "B"}, filled(wanted.size, wanted.size, 3, wanted.value)});
    if (wanted.standard_error > 0)
      image.layers.push_back(
          {basis + "_stderr", {"R", "G", "B"}, filled(wanted.size, wanted.size, 3, wanted.standard_error)});
  }
  image.layers.push_back({"coverage", {""}, filled(wanted.size, wanted.size, 1, 1)});
  write_metadata(metadata, image);
  if (wanted.spoil) wanted.spoil(image);
  return image;
}

/// Folders of lightmaps as a bake leaves them.
class Compare : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }

  CompareSide folder(const std::string& name, const std::vector<WrittenLightmap>& lightmaps) const {
    make_folders(at(name));
    nlohmann::json objects = nlohmann::json::array();
    for (const WrittenLightmap& lightmap : lightmaps) {
      const std::string file = lightmap.key + ".exr";
      write_exr(at(name) / file, lightmap_of(lightmap), Depth::full);
      objects.push_back({{"key", lightmap.key}, {"files", {file}}, {"status", "baked"}});
    }
    write_atomically(at(name) / "manifest.json",
                     nlohmann::json{{"schema_version", 1}, {"objects", objects}}.dump());
    return {at(name), {}, {}};
  }

  void expect_refused(const CompareOptions& options, ExitCode code,
                      const std::vector<std::string>& words) const {
    try {
      static_cast<void>(compare_lightmaps(options));
      FAIL() << "was compared";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      for (const std::string& word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }

 private:
  TempFolder folder_;
};

TEST_F(Compare, MatchesObjectsByKey) {
  const auto a = folder("a", {{"floor", 1.1F}, {"wall", 2.0F}, {"lamp", 1}});
  const auto b = folder("b", {{"wall", 2.0F}, {"shelf", 1}, {"floor", 1.0F}});
  const Report report = compare_lightmaps({a, b});
  ASSERT_EQ(report.objects.size(), 2U);
  EXPECT_EQ(report.objects[0].key, "floor");
  EXPECT_NEAR(report.objects[0].bases[0].metrics.relative_bias.value, 0.1, 1e-6);
  EXPECT_EQ(report.objects[1].bases[0].metrics.relative_bias.value, 0);
  EXPECT_EQ(report.candidate_only, std::vector<std::string>{"lamp"});
  EXPECT_EQ(report.reference_only, std::vector<std::string>{"shelf"});
  EXPECT_EQ(report.candidate_label, "a");
  EXPECT_EQ(report.reference_label, "b");
  ASSERT_EQ(report.scene.size(), 4U);
  EXPECT_NEAR(report.scene[2].metrics.relative_bias.value, 0.1 / 3, 1e-6);
  EXPECT_EQ(report.objects[0].maps.size(), 4U);
  EXPECT_FALSE(report.finding.empty());
  EXPECT_FALSE(to_html(report).empty());
}

TEST_F(Compare, TakesOnlyTheObjectsAskedFor) {
  const auto a = folder("a", {{"floor"}, {"wall"}}), b = folder("b", {{"floor"}, {"wall"}});
  CompareOptions options{a, b};
  options.objects = {"w*"};
  EXPECT_EQ(compare_lightmaps(options).objects.size(), 1U);
  options.objects = {"roof"};
  expect_refused(options, ExitCode::invalid_input, {"no object in common", "--objects"});
}

TEST_F(Compare, ComparesBasesThatBothHave) {
  const auto a = folder("a", {{.key = "floor", .bases = {"flat", "rnm2"}}});
  const Report report = compare_lightmaps({a, folder("b", {{"floor"}})});
  ASSERT_EQ(report.objects[0].bases.size(), 2U);
  EXPECT_EQ(report.objects[0].bases[1].name, "rnm2");
  const auto c = folder("c", {{.key = "floor", .bases = {"rnm0"}}});
  expect_refused({a, c}, ExitCode::invalid_input, {"'floor'", "no basis in common"});
}

TEST_F(Compare, TwoFilesAreComparedWhateverTheirKeys) {
  const auto a = folder("a", {{"floor", 1.5F}}), b = folder("b", {{"roof", 1}});
  const CompareSide one{a.path / "floor.exr", {}, {}}, other{b.path / "roof.exr", {}, "truth"};
  const Report report = compare_lightmaps({one, other});
  ASSERT_EQ(report.objects.size(), 1U);
  EXPECT_EQ(report.objects[0].key, "floor");
  EXPECT_NEAR(report.objects[0].bases[0].metrics.bias.value, 0.5, 1e-6);
  EXPECT_EQ(report.reference_label, "truth");
  EXPECT_TRUE(report.candidate_only.empty());
  expect_refused({one, b}, ExitCode::usage, {"both be folders, or both files"});
}

TEST_F(Compare, OneFileForEachLayerIsTheSame) {
  const auto a = folder("a", {{"floor", 1.25F}}), b = folder("b", {{"floor", 1}});
  make_folders(at("split"));
  nlohmann::json files;
  for (const LayerFile& part : one_file_per_layer(lightmap_of({"floor", 1.25F}))) {
    files.push_back("floor_" + part.name + ".exr");
    write_exr(at("split") / files.back().get<std::string>(), part.image, Depth::full);
  }
  const nlohmann::json object{{"key", "floor"}, {"files", files}};
  write_atomically(at("split") / "manifest.json",
                   nlohmann::json{{"schema_version", 1}, {"objects", {object}}}.dump());
  const Report report = compare_lightmaps({{at("split"), {}, {}}, b});
  ASSERT_EQ(report.objects[0].bases.size(), 4U);
  EXPECT_NEAR(report.objects[0].bases[3].metrics.relative_bias.value, 0.25, 1e-6);

  const CompareSide flat{at("split") / "floor_flat.exr", {}, {}};
  EXPECT_EQ(compare_lightmaps({flat, {b.path / "floor.exr", {}, {}}}).objects[0].bases.size(), 1U);
}

TEST_F(Compare, CountsWhatBothCoverAndWhatIsSound) {
  WrittenLightmap left{"floor", 2}, right{"floor", 1};
  left.spoil = [](LayeredImage& image) { image.layers.back().pixels.texel(0, 0)[0] = 0; };
  right.spoil = [](LayeredImage& image) {
    image.layers.back().pixels.texel(1, 0)[0] = 0;
    FloatImage validity = filled(picture_size, picture_size, 1, 1);
    validity.texel(2, 0)[0] = 0.25F;
    image.layers.push_back({"validity", {""}, validity});
  };
  CompareOptions options{folder("a", {left}), folder("b", {right})};
  Report report = compare_lightmaps(options);
  EXPECT_EQ(report.objects[0].bases[0].metrics.texels, 254U);
  EXPECT_NEAR(report.objects[0].coverage, 254 / 256.0, 1e-12);
  EXPECT_NEAR(report.objects[0].validity, 253 / 254.0, 1e-12);
  EXPECT_TRUE(std::isnan(report.objects[0].maps[0].candidate.texel(0, 0)[0]));
  options.min_validity = 0.5F;
  EXPECT_EQ(compare_lightmaps(options).objects[0].bases[0].metrics.texels, 253U);
}

TEST_F(Compare, NonFiniteTexelsAreCountedApart) {
  WrittenLightmap left{"floor", 1};
  left.spoil = [](LayeredImage& image) {
    image.layers[1].pixels.texel(3, 3)[1] = std::numeric_limits<float>::quiet_NaN();
  };
  const Report report = compare_lightmaps({folder("a", {left}), folder("b", {{"floor"}})});
  EXPECT_EQ(report.objects[0].bases[0].metrics.non_finite, 0U);
  EXPECT_EQ(report.objects[0].bases[1].metrics.non_finite, 1U);
  EXPECT_EQ(report.objects[0].bases[1].metrics.texels, 255U);
}

TEST_F(Compare, NoiseIsTakenFromHalvesAndFromLayers) {
  CompareOptions options{folder("a", {{"floor", 0.9F, 1}}),
                         folder("b", {{.key = "floor", .standard_error = 0.05F}})};
  options.candidate.second = folder("a2", {{"floor", 1.1F, 2}}).path;
  const PictureMetrics metrics = compare_lightmaps(options).objects[0].bases[0].metrics;
  EXPECT_TRUE(metrics.candidate_noise_known);
  EXPECT_TRUE(metrics.reference_noise_known);
  EXPECT_NEAR(metrics.bias.value, 0, 1e-6);
  EXPECT_NEAR(metrics.candidate_noise, 0.1, 1e-6);
  EXPECT_NEAR(metrics.reference_noise, 0.05, 1e-6);
  EXPECT_EQ(metrics.rmse.value, 0);
  options.candidate.second.clear();
  EXPECT_FALSE(compare_lightmaps(options).objects[0].bases[0].metrics.candidate_noise_known);
}

TEST_F(Compare, HalvesMustDifferInTheirSeedAndHoldTheSame) {
  CompareOptions options{folder("a", {{"floor"}, {"wall"}}), folder("b", {{"floor"}, {"wall"}})};
  options.candidate.second = folder("same", {{"floor"}, {"wall"}}).path;
  expect_refused(options, ExitCode::invalid_input, {"'floor'", "same seed", "--seed"});
  options.candidate.second = folder("less", {{"floor", 1, 2}}).path;
  expect_refused(options, ExitCode::invalid_input, {"'wall'", "less"});
}

TEST_F(Compare, RefusesWhatDoesNotFit) {
  const auto b = folder("b", {{"floor"}});
  const auto refused = [&](const std::string& name, const WrittenLightmap& lightmap,
                           const std::string& word) {
    expect_refused({folder(name, {lightmap}), b}, ExitCode::invalid_input, {"'floor'", word});
  };
  refused("size", {.key = "floor", .size = 8}, "the size is 8x8");
  refused("green", {.key = "floor", .change = [](auto& m) { m.green = Green::y_down; }}, "green is y-down");
  refused("units", {.key = "floor", .change = [](auto& m) { m.units = std::string("E"); }}, "the unit is E ");
  refused("convention", {.key = "floor", .change = [](auto& m) { m.convention = std::string("projection"); }},
          "the convention is projection");
  refused("space", {.key = "floor", .change = [](auto& m) { m.space = std::string("world"); }},
          "the space is world");
  refused("scaled", {.key = "floor", .change = [](auto& m) { m.normalize = Normalize::flat; }},
          "normalize is flat");
  refused("vector",
          {.key = "floor",
           .change =
               [](auto& m) {
                 m.bases[1].direction = {1, 0, 0};
               }},
          "the direction of basis rnm0 is (1.0000, 0.0000, 0.0000)");
}

TEST_F(Compare, RefusesWhatIsNoOutputOfOurs) {
  const auto a = folder("a", {{"floor"}});
  expect_refused({a, {at("nowhere"), {}, {}}}, ExitCode::io, {"nowhere"});
  make_folders(at("empty"));
  expect_refused({a, {at("empty"), {}, {}}}, ExitCode::io, {"no manifest.json"});
  expect_refused({a, folder("other", {{"roof"}})}, ExitCode::invalid_input, {"no object in common"});
  const std::vector<std::string> broken{
      "no json",
      "[]",
      "{\"objects\": []}",
      std::string(100000, '[') + std::string(100000, ']'),
      "{\"schema_version\": 1, \"objects\": 3}",
      "{\"schema_version\": 1, \"objects\": [{\"key\": 1, \"files\": []}]}",
      R"({"schema_version": 1, "objects": [{"key": "floor", "files": ["../a/floor.exr"]}]})",
      R"({"schema_version": 1, "objects": [{"key": "floor", "files": ["floor.exr\u0000.png"]}]})",
      R"({"schema_version": 1, "objects": [{"key": "x", "files": ["x.exr"]}, {"key": "x", "files": ["x.exr"]}]})"};
  for (const std::string& text : broken) {
    write_atomically(at("empty") / "manifest.json", text);
    expect_refused({a, {at("empty"), {}, {}}}, ExitCode::invalid_input, {"manifest.json"});
  }
  write_atomically(at("empty") / "manifest.json",
                   R"({"schema_version": 1, "objects": [{"key": "floor", "files": ["gone.exr"]}]})");
  expect_refused({a, {at("empty"), {}, {}}}, ExitCode::io, {"gone.exr"});
  write_atomically(at("empty") / "manifest.json", R"({"schema_version": 99, "objects": []})");
  expect_refused({a, {at("empty"), {}, {}}}, ExitCode::unsupported,
                 {"manifest.json", "schema_version is 99"});
}

TEST_F(Compare, TellsWhatTheReferenceCouldNotFollow) {
  const auto a = folder("a", {{"floor"}}), b = folder("b", {{"floor"}});
  auto manifest = nlohmann::json::parse(read_text(b.path / "manifest.json"));
  manifest["objects"][0]["outside_model"] = {"glossy", "volume"};
  manifest["outside_model"] = {{{"owner", "object 'floor'"}, {"what", {"glossy", "volume"}}},
                               {{"owner", "light 'Lamp'"}, {"what", {"node tree"}}}};
  write_atomically(b.path / "manifest.json", manifest.dump());
  const Report report = compare_lightmaps({a, b});
  EXPECT_EQ(report.objects[0].outside_model, (std::vector<std::string>{"glossy", "volume"}));
  EXPECT_EQ(report.notes, std::vector<std::string>{"outside the reference's model: light 'Lamp': node tree"});
}

TEST_F(Compare, FailedObjectsHaveNoPartner) {
  const auto a = folder("a", {{"floor"}, {"wall"}}), b = folder("b", {{"floor"}});
  auto manifest = nlohmann::json::parse(read_text(b.path / "manifest.json"));
  manifest["objects"].push_back({{"key", "wall"}, {"files", nlohmann::json::array()}, {"status", "failed"}});
  write_atomically(b.path / "manifest.json", manifest.dump());
  const Report report = compare_lightmaps({a, b});
  EXPECT_EQ(report.objects.size(), 1U);
  EXPECT_EQ(report.candidate_only, std::vector<std::string>{"wall"});
}

}  // namespace
}  // namespace rnmbake
