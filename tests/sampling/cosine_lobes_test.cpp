#include "sampling/cosine_lobes.h"

#include "sampling/chi_square.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const Vec3 face(0, 0, 1);

CosineLobes lobes(bool uniform) {
  CosineLobes lobes(face, uniform);
  lobes.add(face);
  lobes.add(unit(Vec3(0.8F, 0.1F, 0.6F)));
  lobes.add(unit(Vec3(-0.3F, 0.9F, -0.2F)));  // mostly below the face: mirrored up
  return lobes;
}

TEST(CosineLobesTest, DirectionsFollowTheDensity) {
  for (const bool uniform : {false, true}) {
    const CosineLobes mixture = lobes(uniform);
    const DirectionGrid grid(0);
    const auto expected = grid.integrals([&](const Vec3& d) { return mixture.pdf(d); });
    // A clamped cosine has a kink: the midpoint rule is off by the square of a step, here (2 pi / 480)^2
    // / 24.
    EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), 1, 1e-5) << uniform;
    SplitMix64 random(7);
    const auto map = [&](const Vec2& u) {
      return mixture.sample(static_cast<float>(random.next() >> 40) * 0x1p-24F, u);
    };
    EXPECT_GT(grid.tail(map, expected, 8), significance) << uniform;
  }
}

TEST(CosineLobesTest, NoCosineIsLargerThanItsBound) {
  const CosineLobes mixture = lobes(false);
  SplitMix64 random(9);
  for (int i = 0; i < 1000; ++i) {
    const auto next = [&] { return static_cast<float>(random.next() >> 40) * 0x1p-24F; };
    const float z = next(), angle = static_cast<float>(2 * pi) * next(), r = std::sqrt(1 - z * z);
    const Vec3 d(r * std::cos(angle), r * std::sin(angle), z);
    const float bound = 3 * static_cast<float>(pi) * mixture.pdf(d);
    EXPECT_LE(std::max(0.0F, d.dot(unit(Vec3(0.8F, 0.1F, 0.6F)))), bound * (1 + 1e-6F));
  }
}

TEST(CosineLobesTest, NothingIsBelowTheFace) {
  EXPECT_EQ(lobes(true).pdf(unit(Vec3(0.8F, 0.1F, -0.6F))), 0);
}

}  // namespace
}  // namespace rnmbake
