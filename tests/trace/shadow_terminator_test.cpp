#include "trace/shadow_terminator.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr float edge = 0.1F;
const Vec3 middle(1 / 3.0F);
constexpr float next_order = edge * edge * edge * edge;  // of the series that what follows is the start of

/// An even triangle in the plane z = 0 with the normals of a sphere of radius 1; `side` -1: of a bowl.
SmoothTriangle cap(float side = 1) {
  const float out = edge / std::sqrt(3.0F);
  SmoothTriangle triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    const float angle = float(2 * pi / 3) * float(k);
    const Vec3 position(out * std::cos(angle), out * std::sin(angle), 0);
    triangle.positions[k] = position;
    triangle.normals[k] = (Vec3(0, 0, std::sqrt(1 - out * out)) + position * side).normalized();
  }
  return triangle;
}

TEST(Bulge, AFlatTriangleHasNone) {
  SmoothTriangle flat = cap();
  for (Vec3& normal : flat.normals) normal = Vec3(0, 0, 1);
  EXPECT_EQ(terminator_offset(flat, middle), Vec3(0));
}

TEST(Bulge, ThereIsNoneAtTheCornersOfARoundedOne) {
  for (const Vec3& corner : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    EXPECT_LT(terminator_offset(cap(), corner).length(), 1e-6F);
  }
}

// The tangent planes of a sphere's corners meet twice as high as the sphere itself over the middle of them.
TEST(Bulge, TheMiddleOfARoundedOneRisesToTheTangentPlanes) {
  EXPECT_NEAR(terminator_offset(cap(), middle).z, edge * edge / 3, next_order);
}

// Raised to the far corners the planes of a bowl are edge^2 / 2 over a corner, edge^2 / 6 over the middle.
TEST(Bulge, AHollowOneRisesToItsRim) {
  EXPECT_NEAR(terminator_offset(cap(-1), middle).z, edge * edge / 6, next_order);
}

}  // namespace
}  // namespace rnmbake
