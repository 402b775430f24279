#include "ssbump/directions/direction_rows.h"

#include "base/error.h"
#include "encoding/direction_sets.h"
#include "ssbump/height_fields.h"
#include "ssbump/map/normals.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Light of an even sky, E/pi of 1 in the open: sum of s_i LM_i with LM_i = (1 + B_z) / 2.
double under_even_sky(std::span<const float> weights, const BasisSet& set) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    sum += double{weights[i] * (1 + set.directions[i].direction.z) / 2};
  return sum;
}

TEST(DirectionRows, AFlatMapIsTheFlatLightmapAlone) {
  const HeightField field = field_of(4, 4, WrapMode::wrap, [](int, int) { return 3; });
  const BasisSet set = *direction_set("h6");
  const FloatImage weights = DirectionRows(field, {set}).rows(0, 4);
  for (std::size_t i = 0; i < weights.data().size(); ++i)
    EXPECT_NEAR(weights.data()[i], i % set.directions.size() == 0 ? 1 : 0, 1e-4);
}

TEST(DirectionRows, AWallTakesHalfOfAnEvenSkyAndAllOfASunBehindIt) {
  const HeightField step = field_of(8, 3, WrapMode::none, [](int x, int) { return x < 4 ? 0 : 4000; });
  const BasisSet set = *direction_set("sh3");
  const FloatImage weights = DirectionRows(step, {set, WeightSign::free, 4096}).rows(1, 2);
  // The texel before the wall has a normal of its own, which leans away; the next but one is flat.
  const auto texel = weights.texel(1, 0);
  EXPECT_NEAR(under_even_sky(texel, set), 0.5, 0.01);
  const auto light = [&](const Vec3& sun) {
    double sum = 0;
    for (std::size_t i = 0; i < texel.size(); ++i)
      sum += double{texel[i] * std::max(0.0F, sun.dot(set.directions[i].direction))};
    return sum;
  };
  EXPECT_LT(light(Vec3(0.8F, 0, 0.6F)), 0.25 * 0.6);   // behind the wall
  EXPECT_GT(light(Vec3(-0.8F, 0, 0.6F)), 0.75 * 0.6);  // before it
}

/// The same sums by brute force, over another sampling of the hemisphere.
TEST(DirectionRows, AgreesWithBruteForce) {
  const HeightField field = rough_field(32, 32, WrapMode::wrap, 8);
  const BasisSet set = *direction_set("l1");
  const FloatImage weights = DirectionRows(field, {set, WeightSign::free, 4096}).rows(5, 6);
  const FloatImage normals = height_normals(field, 5, 6);
  const HeightRays surface(field);
  std::vector<Vec3> directions;
  constexpr int rings = 64, around = 128;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k)
      directions.emplace_back(direction_at(std::acos((i + 0.5) / rings), 2 * pi * (k + 0.5) / around));
  std::vector<Vec3> axes;
  for (const BasisDirection& basis : set.directions) axes.push_back(basis.direction);
  const DirectionWeights fit(axes, directions);
  for (const int x : {0, 7, 13, 22, 31}) {
    std::vector<float> response, expected(axes.size());
    double open = 0;
    for (const Vec3& direction : directions) {
      const auto n = normals.texel(x, 0);
      const float cosine = std::max(0.0F, direction.dot(Vec3(n[0], n[1], n[2])));
      response.push_back(surface.occluded(x, 5, direction) ? 0 : cosine);
      open += double{2 * response.back()} / (rings * around);
    }
    EXPECT_NEAR(under_even_sky(weights.texel(x, 0), set), open, 0.01);
    fit.solve(response, WeightSign::free, expected);
    for (std::size_t i = 0; i < axes.size(); ++i)
      EXPECT_NEAR(weights.texel(x, 0)[i], expected[i], 0.05) << x << " " << i;
  }
}

TEST(DirectionRows, DependsOnTheSeedAloneAndRefusesTooFewRays) {
  const HeightField field = rough_field(16, 16, WrapMode::wrap, 4);
  DirectionOptions options{*direction_set("h6")};
  const FloatImage all = DirectionRows(field, options).rows(0, 16);
  options.threads = 1;
  const FloatImage lower = DirectionRows(field, options).rows(8, 16);
  for (int x = 0; x < 16; ++x)
    for (std::size_t c = 0; c < 10; ++c) EXPECT_EQ(all.texel(x, 11)[c], lower.texel(x, 3)[c]);
  options.rays = 79;
  EXPECT_THROW((void)DirectionRows(field, options).rows(0, 1), Error);
}

}  // namespace
}  // namespace rnmbake
