#include "trace/lights/light_tree.h"

#include "trace/lights/light_support.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  float operator()() { return static_cast<float>(random_() >> 8) * 0x1p-24F; }
  float between(float low, float high) { return low + (high - low) * (*this)(); }
  Vec3 place(float extent) {
    return {between(-extent, extent), between(-extent, extent), between(-extent, extent)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = place(1);
      if (v.length2() > 0.01F && v.length2() < 1) return v.normalized();
    }
  }

 private:
  std::mt19937 random_;
};

/// Points, spots and one- and two-sided flat lights.
std::vector<LightBounds> some_lights(Dice& dice, int count) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < count; ++i) {
    LightBounds light;
    light.low = dice.place(10);
    light.high = light.low;
    light.power = dice.between(0.1F, 5);
    if (i % 4 != 0) {
      light.axis = dice.direction();
      light.normals = 1;
      light.emission = i % 4 == 1 ? 0.8F : 0.0F;
      light.two_sided = i % 4 == 3;
    }
    if (i % 4 > 1) light.high += Vec3(dice(), dice(), dice());
    lights.push_back(light);
  }
  return lights;
}

TEST(LightTreeTest, ProbabilitiesSumToOneAndAreKept) {
  Dice dice(1);
  for (const int count : {1, 2, 7, 8, 9, 60, 1000}) {
    const std::vector<LightBounds> lights = some_lights(dice, count);
    const LightTree tree(lights);
    for (int i = 0; i < 20; ++i) {
      const Vec3 point = dice.place(12), normal = i % 2 == 0 ? nowhere : dice.direction();
      double sum = 0;
      for (std::uint32_t light = 0; light < lights.size(); ++light) {
        sum += tree.probability(point, normal, light);
      }
      // Groups may promise what their lights do not keep: then nothing is chosen now and then.
      EXPECT_LE(sum, 1 + 64 * 0x1p-24);  // a dozen levels, each of a few roundings
      for (int k = 0; k < 100; ++k) {
        float u = dice();
        const LightTree::Choice choice = tree.choose(point, normal, u);
        if (choice.probability == 0) continue;
        EXPECT_NEAR(tree.probability(point, normal, choice.light), choice.probability,
                    1e-5 * choice.probability);
        EXPECT_GE(u, 0);
        EXPECT_LT(u, 1);
      }
    }
  }
}

TEST(LightTreeTest, ChoicesComeAsOftenAsTheirProbabilitySays) {
  Dice dice(2);
  const std::vector<LightBounds> lights = some_lights(dice, 40);
  const LightTree tree(lights);
  const Vec3 point(1, 2, 0);
  std::vector<int> seen(lights.size());
  constexpr int samples = 400000;
  double reused = 0;
  for (int i = 0; i < samples; ++i) {
    float u = dice();
    const LightTree::Choice choice = tree.choose(point, up, u);
    if (choice.probability > 0) ++seen[choice.light];
    reused += u;
  }
  EXPECT_NEAR(reused / samples, 0.5, 4 * std::sqrt(1.0 / 12 / samples));
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const double p = tree.probability(point, up, i);
    EXPECT_NEAR(double(seen[i]) / samples, p, 4.5 * std::sqrt(p * (1 - p) / samples) + 1e-6) << i;
  }
}

/// Whether light leaves a place of the light towards the point and meets its upper side.
bool can_light(const LightBounds& light, const Vec3& place, const Vec3& point, const Vec3& normal) {
  const Vec3 out = (point - place).normalized();
  if (normal != nowhere && out.dot(normal) >= -1e-6F) return false;
  if (light.normals <= -1) return true;
  const float along = light.two_sided ? std::abs(out.dot(light.axis)) : out.dot(light.axis);
  return along > light.emission + 1e-6F;
}

TEST(LightTreeTest, WhatCanGiveLightCanBeChosen) {
  Dice dice(3);
  for (const int count : {5, 100, 3000}) {
    const std::vector<LightBounds> lights = some_lights(dice, count);
    const LightTree tree(lights);
    for (int i = 0; i < 300; ++i) {
      const Vec3 point = dice.place(11), normal = i % 3 == 0 ? nowhere : dice.direction();
      for (std::uint32_t k = 0; k < lights.size(); ++k) {
        const LightBounds& light = lights[k];
        const Vec3 size = light.high - light.low;
        const Vec3 place = light.low + Vec3(size.x * dice(), size.y * dice(), size.z * dice());
        if (can_light(light, place, point, normal)) {
          ASSERT_GT(tree.probability(point, normal, k), 0) << k;
        }
      }
    }
  }
}

TEST(LightTreeTest, LightsBehindTheSurfaceAreLeftOut) {
  std::vector<LightBounds> lights(2);
  lights[0].low = lights[0].high = Vec3(0, 0, -1);
  lights[1].low = lights[1].high = Vec3(0, 0, 1);
  lights[0].power = 1000;
  lights[1].power = 1;
  const LightTree tree(lights);
  EXPECT_EQ(tree.probability({0, 0, 0}, up, 0), 0);
  EXPECT_EQ(tree.probability({0, 0, 0}, up, 1), 1);
  EXPECT_GT(tree.probability({0, 0, 0}, nowhere, 0), 0.99F);
  EXPECT_EQ(LightTree({lights[0]}).importance({0, 0, 0}, up), 0);
}

TEST(LightTreeTest, ManyInOnePlaceAndVeryUnevenOnes) {
  std::vector<LightBounds> same(5000);
  for (LightBounds& light : same) light.power = 1;
  const LightTree stacked(same);
  double sum = 0;
  for (std::uint32_t i = 0; i < same.size(); ++i) sum += stacked.probability({0, 0, 1}, nowhere, i);
  EXPECT_NEAR(sum, 1, 1e-4);
  EXPECT_GT(stacked.probability({0, 0, 0}, nowhere, 17), 0) << "on the lights";

  std::vector<LightBounds> uneven(200);
  for (std::size_t i = 0; i < uneven.size(); ++i) {  // each half of the rest: as lopsided as a tree can be
    const float x = std::ldexp(1.0F, -static_cast<int>(std::min<std::size_t>(i, 120)));
    uneven[i].low = uneven[i].high = Vec3(x, 0, 0);
    uneven[i].power = x;
  }
  const LightTree lopsided(uneven);
  sum = 0;
  for (std::uint32_t i = 0; i < uneven.size(); ++i) sum += lopsided.probability({0, 0, 1}, nowhere, i);
  EXPECT_NEAR(sum, 1, 1e-4);
}

TEST(LightTreeTest, NoLights) {
  float u = 0.5F;
  const LightTree tree{std::vector<LightBounds>{}};
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(tree.choose({0, 0, 0}, up, u).probability, 0);
  EXPECT_EQ(tree.importance({0, 0, 0}, up), 0);
}

}  // namespace
}  // namespace rnmbake
