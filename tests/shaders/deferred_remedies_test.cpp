#include "shader_runs.h"
#include "support/deferred_shadows.h"

#include <algorithm>
#include <array>

namespace rnmbake {
namespace {

constexpr int side = 64, edge = 32;  // columns from `edge` on show the thing in front
constexpr float ground_depth = 4, thing_depth = 2;

/// A flat ground that faces the camera, and to the right, two units before it, a thing whose face is turned
/// away from the light, which comes from the right. To a walk that knows normals alone the thing is a slope
/// that rises out of the ground.
struct Step {
  Step() : input(), object(side, side, 1) {
    input.normals = FloatImage(side, side, 3);
    input.depths = FloatImage(side, side, 1);
    const Vec3 turned = unit(Vec3(-0.8F, 0, 0.6F));
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const bool thing = x >= edge;
        const Vec3 normal = thing ? turned : Vec3(0, 0, 1);
        for (int c = 0; c < 3; ++c) input.normals.texel(x, y)[std::size_t(c)] = normal[c];
        input.depths.texel(x, y)[0] = thing ? thing_depth : ground_depth;
        object.texel(x, y)[0] = thing ? 2 : 1;
      }
    }
    input.walk = Vec2(1, -1);  // a quarter of the picture over the ground
  }
  DeferredInput input;
  FloatImage object;
  Vec3 light = unit(Vec3(0.9F, 0, 0.3F));
};

/// The least light that is left of the ground's pixels.
float darkest_ground(const Step& step, const FloatImage& tested, float range) {
  DeferredInput input = step.input;
  input.tested = tested;
  input.range = range;
  const FloatImage left = deferred_shadows(gl_compute(), input, step.light);
  float darkest = 1;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < edge; ++x) darkest = std::min(darkest, left.texel(x, y)[0]);
  return darkest;
}

TEST(DeferredRemedies, WithoutOneAStepOfDepthCastsAFalseShadow) {
  const Step step;
  EXPECT_LT(darkest_ground(step, step.input.depths, 1e6F), 0.1F);
}

TEST(DeferredRemedies, TheDepthTestLeavesItOut) {
  const Step step;
  EXPECT_EQ(darkest_ground(step, step.input.depths, 0.5F), 1);
  EXPECT_LT(darkest_ground(step, step.input.depths, 40), 0.5F) << "a range beyond the step keeps it";
}

TEST(DeferredRemedies, AStencilLeavesItOut) {
  const Step step;
  EXPECT_EQ(darkest_ground(step, stencilled(FloatImage(side, side, 1), step.object, 1), 1), 1);
  EXPECT_EQ(darkest_ground(step, stencilled(step.input.depths, step.object, 1), 1e6F), 1);
}

/// The G-buffer of the pass before the thing is drawn.
TEST(DeferredRemedies, SoDoesThePassBefore) {
  Step step;
  for (int y = 0; y < side; ++y) {
    for (int x = edge; x < side; ++x) {
      const std::array<float, 3> up{0, 0, 1};
      std::ranges::copy(up, step.input.normals.texel(x, y).begin());
      step.input.depths.texel(x, y)[0] = ground_depth;
    }
  }
  EXPECT_EQ(darkest_ground(step, step.input.depths, 1e6F), 1);
}

}  // namespace
}  // namespace rnmbake
