#include "pipeline/ssbump/decode_directions.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/direction_sets.h"
#include "encoding/flip_green.h"
#include "ssbump/directions/direction_rows.h"
#include "ssbump/height_fields.h"
#include "support/pictures.h"

#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A lightmap of one far lamp of E/pi 1 towards `sun`, as it is baked.
Lightmap under_sun(const BasisSet& set, const Vec3& sun, Green green = Green::y_up) {
  Lightmap lightmap;
  lightmap.metadata.bases = set.directions;
  lightmap.metadata.green = green;
  for (const auto& [name, direction] : set.directions) {
    const Vec3 seen = green == Green::y_up ? direction : flip_green(direction);
    lightmap.layers[name] = filled(2, 2, 3, std::max(0.0F, sun.dot(seen)));
  }
  return lightmap;
}

DirectionMap bumps_of(const BasisSet& set) {
  const HeightField field = rough_field(8, 8, WrapMode::wrap, 4);
  return {{set, "free", "trace", ""}, DirectionRows(field, {set}).rows(0, 8), "float"};
}

std::string refusal_of(Lightmap lightmap, const DirectionMap& map) {
  try {
    (void)decode_directions(std::move(lightmap), map);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unsupported);
    return error.what();
  }
  return "";
}

TEST(DecodeDirections, IsTheSumOfWeightsTimesMaps) {
  const BasisSet set = *direction_set("h6");
  const DirectionMap map = bumps_of(set);
  const Vec3 sun = Vec3(0.5F, 0.3F, 0.7F).normalized();
  const FloatImage lit = decode_directions(under_sun(set, sun), map);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      float sum = 0;
      for (std::size_t i = 0; i < set.directions.size(); ++i)
        sum += map.weights.texel(x, y)[i] * std::max(0.0F, sun.dot(set.directions[i].direction));
      EXPECT_NEAR(lit.texel(x, y)[1], std::max(0.0F, sum), 1e-5);
    }
  }
}

TEST(DecodeDirections, ALightmapWithYDownGivesTheSameLight) {
  const Vec3 sun = Vec3(0.5F, 0.6F, 0.5F).normalized();
  for (const char* name : {"l1", "h6", "sh3"}) {
    const BasisSet set = *direction_set(name);
    const DirectionMap map = bumps_of(set);
    EXPECT_LT(largest_difference(decode_directions(under_sun(set, sun), map),
                                 decode_directions(under_sun(set, sun, Green::y_down), map)),
              1e-5)
        << name;
  }
}

TEST(DecodeDirections, TakesALargerSetAndRefusesASmallerByName) {
  const Vec3 sun(0, 0.6F, 0.8F);
  const DirectionMap map = bumps_of(*direction_set("h6"));
  EXPECT_EQ(largest_difference(decode_directions(under_sun(*direction_set("h6"), sun), map),
                               decode_directions(under_sun(*direction_set("sh3"), sun), map)),
            0);
  EXPECT_EQ(
      refusal_of(under_sun(*direction_set("l1"), sun), map),
      "the self-shadowed bump map is of the set h6 and the lightmap of l1, which has no 'd3'; bake with the "
      "map's set, or make the map with the lightmap's");
  EXPECT_NE(refusal_of(under_sun(flat_and_rnm(), sun), map).find("the lightmap of rnm,"), std::string::npos);
}

TEST(DecodeDirections, RefusesLightmapsThatAreNotAsTheyWereBaked) {
  const DirectionMap map = bumps_of(*direction_set("h6"));
  Lightmap lightmap = under_sun(*direction_set("h6"), Vec3(0, 0, 1));
  lightmap.metadata.normalize = Normalize::flat;
  EXPECT_NE(refusal_of(lightmap, map).find("--normalize none"), std::string::npos);
  lightmap.metadata.normalize = Normalize::none;
  lightmap.metadata.convention = "zh3";
  EXPECT_NE(refusal_of(lightmap, map).find("zh3"), std::string::npos);
}

TEST(DirectionMap, ComesBackFromItsFileAsItWas) {
  TempFolder folder;
  const auto file = folder.path() / "map.exr";
  const DirectionMap map = bumps_of(*direction_set("sh3"));
  PictureWriter writer(file, direction_map_form(map.metadata, 8, 8, Storage::full));
  writer.write(0, 8, map.weights.data());
  writer.commit();
  const auto read = read_direction_map(file);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->weights.data(), map.weights.data());
  EXPECT_EQ(read->metadata.set.name, "sh3");
  EXPECT_EQ(read->metadata.fit, "free");
  EXPECT_EQ(read->storage, "float");
  EXPECT_EQ(name_of_set(read->metadata.set.directions), "sh3");
}

TEST(DirectionMap, RefusesAHeaderThatItsChannelsContradict) {
  TempFolder folder;
  const auto file = folder.path() / "map.exr";
  PictureForm form = direction_map_form({flat_and_rnm(), "", "", ""}, 1, 1, Storage::full);
  form.attributes["rnmbake:basis"] = std::string("flat,rnm0,rnm1,rnm2,d0");
  form.attributes["rnmbake:basis:d0"] = std::vector<float>{0.6F, 0, 0.8F};
  PictureWriter writer(file, form);
  writer.write(0, 1, std::vector<float>{1, 0, 0, 0});
  writer.commit();
  EXPECT_THROW((void)read_direction_map(file), Error);
}

}  // namespace
}  // namespace rnmbake
