#include "lightmap/metadata.h"

#include "base/error.h"
#include "base/files.h"

#include <functional>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

LightmapMetadata example() {
  LightmapMetadata metadata;
  metadata.bases = flat_and_rnm().directions;
  metadata.green = Green::y_down;
  metadata.normalize = Normalize::flat;
  metadata.recipe = "receiver";
  metadata.horizon = "exact";
  metadata.footprint = "half texel";
  metadata.samples = 256;
  metadata.bounces = 32;
  metadata.seed = 7;
  metadata.repaired = true;
  metadata.rnmbake_version = "0.1.0";
  metadata.blender_version = "4.3.2";
  metadata.object = "Wände/ö";
  metadata.uv_layer = "Lightmap";
  metadata.tangent_uv_layer = "UVMap";
  return metadata;
}

LayeredImage image_with(const LightmapMetadata& metadata) {
  LayeredImage image;
  for (const BasisDirection& basis : metadata.bases)
    image.layers.push_back({basis.name == "flat" ? "" : basis.name, {"R", "G", "B"}, FloatImage(2, 2, 3)});
  write_metadata(metadata, image);
  return image;
}

TEST(Metadata, SurvivesTheFile) {
  const TempFolder folder;
  const auto file = folder.path() / "a.exr";
  write_exr(file, image_with(example()), Depth::half);
  const LayeredImage read = read_image(file);
  EXPECT_TRUE(has_metadata(read));
  const LightmapMetadata got = read_metadata(read, "a.exr"), want = example();
  EXPECT_EQ(got.convention, want.convention);
  EXPECT_EQ(got.units, "E/pi");
  EXPECT_EQ(got.green, Green::y_down);
  EXPECT_EQ(got.normalize, Normalize::flat);
  ASSERT_EQ(got.bases.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(got.bases[i].name, want.bases[i].name);
    EXPECT_EQ(got.bases[i].direction, want.bases[i].direction);
  }
  EXPECT_EQ(got.recipe + got.horizon + got.footprint, want.recipe + want.horizon + want.footprint);
  EXPECT_EQ(got.samples * 10000 + got.bounces * 100 + got.seed, 2563207);
  EXPECT_TRUE(got.repaired);
  EXPECT_EQ(got.rnmbake_version + got.blender_version, "0.1.04.3.2");
  EXPECT_EQ(got.object, want.object);
  EXPECT_EQ(got.uv_layer + got.tangent_uv_layer, "LightmapUVMap");
}

TEST(Metadata, EmptyTextsOfTheOriginMayBeMissing) {
  const TempFolder folder;
  LightmapMetadata metadata = example();
  metadata.recipe = metadata.object = "";
  write_exr(folder.path() / "a.exr", image_with(metadata), Depth::half);
  EXPECT_EQ(read_metadata(read_image(folder.path() / "a.exr"), "a.exr").object, "");
}

TEST(Metadata, WhatIsMissingOrContradictsIsRefusedAndNamed) {
  using Change = std::function<void(LayeredImage&)>;
  const auto set = [](const char* name, Attribute value) -> Change {
    return [=](LayeredImage& image) { image.attributes[name] = value; };
  };
  const auto drop = [](const char* name) -> Change {
    return [=](LayeredImage& image) { image.attributes.erase(name); };
  };
  const std::vector<std::pair<Change, std::string>> cases{
      {drop("rnmbake:convention"), "lacks rnmbake:convention"},
      {drop("rnmbake:units"), "lacks rnmbake:units"},
      {drop("rnmbake:basis"), "lacks rnmbake:basis"},
      {drop("rnmbake:basis:rnm1"), "lacks rnmbake:basis:rnm1"},
      {drop("rnmbake:green"), "lacks rnmbake:green"},
      {set("rnmbake:units", 3), "wrong type"},
      {set("rnmbake:green", std::string("up")), "rnmbake:green is 'up'"},
      {set("rnmbake:normalize", std::string("sometimes")), "rnmbake:normalize is 'sometimes'"},
      {set("rnmbake:samples", std::string("many")), "rnmbake:samples has the wrong type"},
      {set("rnmbake:basis:rnm0", std::vector<float>{1, 0}), "does not have 3 numbers"},
      {set("rnmbake:basis:rnm0", std::vector<float>{1, 1, 0}), "unit length"},
      {set("rnmbake:basis:flat", std::vector<float>{1, 0, 0}), "'flat' is not (0, 0, 1)"},
      {set("rnmbake:basis:rnm0", std::vector<float>{0, 0, 1}), "one of the three"},
      {set("rnmbake:basis", std::string("rnm0,rnm1,rnm2")), "the flat bake"},
      {set("rnmbake:basis", std::string("flat,rnm0,rnm0")), "listed twice"},
      {set("rnmbake:basis", std::string(",")), "lists nothing"},
      {[](LayeredImage& image) { image.layers.pop_back(); }, "no RGB layer"}};
  for (const auto& [change, part] : cases) {
    LayeredImage image = image_with(example());
    change(image);
    try {
      (void)read_metadata(image, "broken.exr");
      ADD_FAILURE() << "accepted: " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with("broken.exr") && message.find(part) != std::string::npos) << message;
    }
  }
}

TEST(Metadata, AReferenceSaysHowItWasTraced) {
  LightmapMetadata reference = example();
  reference.recipe = "reference";
  reference.bounces = -1;
  reference.model = "flat-normal-map";
  reference.faults = "tilt-clamp,bump-shadowing";
  reference.error = 0.005F;
  const LightmapMetadata got = read_metadata(image_with(reference), "a.exr");
  EXPECT_EQ(got.bounces, -1);
  EXPECT_EQ(got.model, "flat-normal-map");
  EXPECT_EQ(got.faults, "tilt-clamp,bump-shadowing");
  EXPECT_EQ(got.error, 0.005F);
}

TEST(Metadata, ABakeHasNoModel) {
  EXPECT_FALSE(image_with(example()).attributes.contains("rnmbake:model"));
}

}  // namespace
}  // namespace rnmbake
