#include "encoding/encodings.h"

#include "encoding/basis_set.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Encodings, NoTwoShareANameOrAllLayers) {
  std::set<std::string> names;
  std::set<std::set<std::string_view>> sets;
  for (const Encoding& encoding : encodings) {
    EXPECT_TRUE(names.insert(std::string(encoding.name)).second) << encoding.name;
    const std::set<std::string_view> layers(encoding.layers.begin(), encoding.layers.end());
    EXPECT_EQ(layers.size(), encoding.layers.size()) << encoding.name;
    EXPECT_TRUE(sets.insert(layers).second) << encoding.name;
  }
}

TEST(Encodings, TheFlatBakeIsThePlainLayerOfAFile) {
  EXPECT_EQ(exr_layer("flat"), "");
  EXPECT_EQ(exr_layer("rnm1"), "rnm1");
  for (const Encoding& encoding : encodings) {
    for (const auto layer : encoding.layers) EXPECT_EQ(name_of_exr_layer(exr_layer(layer)), layer);
  }
}

TEST(Encodings, BasesThatAreBakedAreNamedAfterThem) {
  const BasisSet rnm = rnm_set();
  ASSERT_EQ(rnm.directions.size(), rnm_encoding.layers.size());
  for (std::size_t i = 0; i < rnm.directions.size(); ++i)
    EXPECT_EQ(rnm.directions[i].name, rnm_encoding.layers[i]);
  EXPECT_EQ(flat_direction().name, flat_encoding.layers.front());
}

}  // namespace
}  // namespace rnmbake
