#include "encoding/refit/packing.h"

#include "encoding/codecs/make_codec.h"
#include "encoding/geomerics.h"
#include "encoding/random_light.h"
#include "encoding/refit/refit.h"
#include "encoding/sh2.h"
#include "encoding/zh3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Axes that are none of tangent space's.
TexelFrame tilted_frame() {
  TexelFrame frame;
  frame.normal = Vec3(1, 2, 2) / 3.0F;
  frame.tangent = Vec3(2, 1, -2) / 3.0F;
  frame.bitangent = Vec3(2, -2, 1) / 3.0F;
  return frame;
}

std::array<Vec3d, 4> stored_directions(const TexelFrame& frame) {
  auto directions = four_directions();
  for (Vec3d& direction : directions) direction = frame.stored(direction);
  return directions;
}

FourBakes lit(const Hemisphere& light) {
  FourBakes wanted{};
  for (std::size_t k = 0; k < 4; ++k) wanted[k] = irradiance(light, four_directions()[k]);
  return wanted;
}

PackedNumbers packed_one(Lobe lobe, const FreeFit& fit, const Packing& packing) {
  return packed(lobe, {&fit, 1}, packing).front();
}

/// What a packed fit leaves over the three directions of the basis.
double left_over(Lobe lobe, const FourBakes& wanted, const std::array<Vec3d, 4>& directions, double a,
                 const Vec3d& ratio) {
  double sum = 0;
  for (std::size_t k = 1; k < 4; ++k) {
    const double error = a * lobe(1, ratio, directions[k]).value - wanted[k];
    sum += error * error;
  }
  return sum;
}

/// The least of a grid over the box, which keeps flat: steps of K/12.
double least_of_grid(Lobe lobe, const FourBakes& wanted, const std::array<Vec3d, 4>& directions,
                     double range) {
  constexpr int steps = 12;
  double least = std::numeric_limits<double>::infinity();
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) {
      for (int z = -steps; z <= steps; ++z) {
        const Vec3d ratio = Vec3d(x, y, z) * (range / steps);
        const double flat = lobe(1, ratio, directions[0]).value;
        if (flat > 0) least = std::min(least, left_over(lobe, wanted, directions, wanted[0] / flat, ratio));
      }
    }
  }
  return least;
}

TEST(Packing, NoPointOfTheBoxIsBetter) {
  std::mt19937 random(1);
  int beyond = 0;
  for (int i = 0; i < 150; ++i) {
    const FourBakes wanted = lit(random_hemisphere(random));
    for (const TexelFrame& frame : {TexelFrame(), tilted_frame()}) {
      const auto directions = stored_directions(frame);
      for (const Lobe lobe : {Lobe(sh2_lobe), Lobe(zh3_lobe), Lobe(geomerics_lobe)}) {
        FourNumbers free_fit = lobe == sh2_lobe ? linear_numbers(wanted) : refit(lobe, wanted);
        free_fit.v = frame.stored(free_fit.v);
        if (!is_out_of_range(free_fit, 2)) continue;
        ++beyond;
        const PackedNumbers found = packed_one(lobe, {wanted, directions, free_fit}, {2, 0});
        const Vec3d ratio = unpacked_ratio(found.t, 2);
        EXPECT_NEAR(found.a * lobe(1, ratio, directions[0]).value, wanted[0], 1e-9 * wanted[0]);
        const double greatest = *std::ranges::max_element(wanted);
        EXPECT_LE(left_over(lobe, wanted, directions, found.a, ratio),
                  least_of_grid(lobe, wanted, directions, 2) + 1e-9 * greatest * greatest);
      }
    }
  }
  EXPECT_GT(beyond, 50);
}

TEST(Packing, StaysWithinAndKeepsFlatWhateverTheBits) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const FourBakes wanted = lit(random_hemisphere(random));
    const auto directions = stored_directions(tilted_frame());
    for (const Lobe lobe : {Lobe(sh2_lobe), Lobe(zh3_lobe), Lobe(geomerics_lobe)}) {
      FourNumbers free_fit = lobe == sh2_lobe ? linear_numbers(wanted) : refit(lobe, wanted);
      free_fit.v = tilted_frame().stored(free_fit.v);
      for (const int bits : {0, 8, 16}) {
        const PackedNumbers found = packed_one(lobe, {wanted, directions, free_fit}, {2, bits});
        const double steps = bits > 0 ? std::ldexp(1.0, bits) - 1 : 0;
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(found.t[axis], 0);
          EXPECT_LE(found.t[axis], 1);
          EXPECT_NEAR(found.t[axis] * steps, std::round(found.t[axis] * steps), 1e-9);
        }
        const double flat = found.a * lobe(1, unpacked_ratio(found.t, 2), directions[0]).value;
        EXPECT_NEAR(flat, wanted[0], 1e-9 * wanted[0]);
      }
    }
  }
}

TEST(Packing, DarkFlatIsDarkness) {
  for (const double flat : {0.0, -1.0}) {
    const FourBakes wanted{flat, 1, 2, 3};
    const PackedNumbers found =
        packed_one(zh3_lobe, {wanted, four_directions(), refit(zh3_lobe, wanted)}, {2, 8});
    EXPECT_EQ(found.a, 0);
    EXPECT_EQ(found.t, Vec3d(0.5));
  }
}

std::vector<Vec3> coloured_light(const BasisSet& set) {
  std::mt19937 random(3);
  return bakes(random_hemisphere(random), random_hemisphere(random), random_hemisphere(random), set);
}

TEST(PackedCodec, WithinTheRangeDecodesAsUnpacked) {
  const BasisSet set = flat_and_rnm();
  const auto light = coloured_light(set);
  for (const char* name : {"sh2", "zh3", "geomerics"}) {
    const auto free = make_codec({name}, set), packed = make_codec({name, 1000}, set);
    std::vector<Vec3> free_layers(4), packed_layers(4);
    (void)free->encode(light, free_layers);
    EXPECT_EQ(packed->encode(light, packed_layers).out_of_range, 0U);
    const Vec3 normal = Vec3(1, 2, 3).normalized();
    // t rounds to 2^-25, times a range of 2000 a.
    EXPECT_LE((free->decode(free_layers, normal) - packed->decode(packed_layers, normal)).length(),
              2000.0F / (1 << 24) * max_channel(free_layers[0]))
        << name;
  }
}

TEST(PackedCodec, MonoKeepsTheFlatColours) {
  const BasisSet set = flat_and_rnm();
  const auto light = coloured_light(set);
  for (const char* name : {"sh2", "zh3", "geomerics"}) {
    const auto codec = make_codec({name, 2, 8, true}, set);
    EXPECT_EQ(codec->layers(), (std::vector<std::string>{"l0", "dir"}));
    std::vector<Vec3> layers(2);
    const TexelFrame frame = tilted_frame();
    (void)codec->encode(light, layers, frame);
    EXPECT_LE((codec->decode(layers, frame.normal) - light[0]).length(), 1e-5F * max_channel(light[0]))
        << name;
    // One shape for all colours.
    const Vec3 tilted = codec->decode(layers, frame.stored(Vec3(0.6F, 0, 0.8F)));
    EXPECT_NEAR(tilted.x / light[0].x, tilted.y / light[0].y, 1e-5) << name;
  }
}

TEST(PackedCodec, OfGreyLightIsMono) {
  const BasisSet set = flat_and_rnm();
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    const auto grey = bakes(random_hemisphere(random), set);
    const auto three = make_codec({"sh2", 4}, set), one = make_codec({"sh2", 4, 0, true}, set);
    std::vector<Vec3> three_layers(4), one_layers(2);
    const auto counts = three->encode(grey, three_layers);
    EXPECT_EQ(one->encode(grey, one_layers).out_of_range, counts.out_of_range);
    const Vec3 normal(random_direction(random));
    EXPECT_LE((three->decode(three_layers, normal) - one->decode(one_layers, normal)).length(),
              1e-5F * max_channel(grey[0]));
  }
}

TEST(PackedCodec, ASunOverheadIsOutOfRange) {
  const BasisSet set = flat_and_rnm();
  const auto sun = bakes({{Vec3d(0, 0, 1), 1}}, set);
  std::vector<Vec3> layers(4);
  const auto codec = make_codec({"sh2", 2}, set);
  EXPECT_EQ(codec->encode(sun, layers).out_of_range, 1U);
  // The best within |v| <= 2a that returns 1 straight up: a = 1/3, v_z = 2/3.
  EXPECT_NEAR(layers[0].x, 1.0 / 3, 1e-6);
  EXPECT_NEAR(layers[3].x, 1, 1e-6);
}

}  // namespace
}  // namespace rnmbake
