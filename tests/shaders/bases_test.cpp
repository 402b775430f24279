// Functions of the normal that are weighed and added: spherical Gaussians, H-basis, cube; and one direction.
#include "encoding/ahd.h"
#include "encoding/ambient_cube.h"
#include "encoding/hbasis.h"
#include "encoding/sg.h"
#include "encoding/unity_dominant.h"
#include "shader_runs.h"

namespace rnmbake {
namespace {

/// Six colours, which light may give or fits make of it, and a normal above the surface.
void six_colours(RandomVectors& random, std::span<Vec3> in) {
  for (std::size_t i = 0; i < 6; ++i) in[i] = random.within(-1, 5);
  in[6] = random.normal_above();
}

Vec3 weighed(std::span<const Vec3> colours, const std::array<double, 6>& weights) {
  Vec3d sum(0);
  for (std::size_t i = 0; i < colours.size(); ++i) sum += Vec3d(colours[i]) * weights[i];
  return Vec3(sum);
}

TEST(Bases, SphericalGaussians) {
  expect_same(
      {{"sg"}, "vec3 sg[6];\nfor (int i = 0; i < 6; ++i) sg[i] = at(i);\nreturn sg_decode(sg, at(6));", 7},
      six_colours, [](auto in) { return weighed(in.first(6), sg_basis(Vec3d(in[6]))); });
}

TEST(Bases, H4AndH6) {
  expect_same({{"h4"}, "return h4_decode(at(0), at(1), at(2), at(3), at(6));", 7}, six_colours,
              [](auto in) { return weighed(in.first(4), h_basis(Vec3d(in[6]))); });
  expect_same({{"h6"}, "return h6_decode(at(0), at(1), at(2), at(3), at(4), at(5), at(6));", 7}, six_colours,
              [](auto in) { return weighed(in.first(6), h_basis(Vec3d(in[6]))); });
}

TEST(Bases, AmbientCube) {
  expect_same(
      {{"ambient_cube"},
       "vec3 cube[6];\nfor (int i = 0; i < 6; ++i) cube[i] = at(i);\n"
       "return ambient_cube_decode(cube, at(6));",
       7},
      [](auto& random, auto in) {
        six_colours(random, in);
        in[6] = random.direction();
      },
      [](auto in) {
        return ambient_cube_decode({in[0], in[1], in[2], in[3], in[4], in[5]}, in[6]);
      });
}

TEST(Bases, AmbientAndHighlightDirection) {
  expect_same(
      {{"ahd"}, "return ahd_decode(at(0), at(1), at(2), at(3));", 4},
      [](auto& random, auto in) {
        for (std::size_t i = 0; i < 2; ++i) in[i] = random.within(0, 5);
        for (std::size_t i = 2; i < 4; ++i) in[i] = random.direction();
      },
      [](auto in) { return ahd_decode(in[0], in[1], in[2], in[3]); });
}

/// The direction and the directionality in bytes, as Unity stores them.
TEST(Bases, UnitysDominantDirection) {
  expect_same(
      {{"dominant"}, "return dominant_decode(at(0), at(1), at(2).x, at(3));", 4},
      [](auto& random, auto in) {
        in[0] = random.within(0, 5);
        in[1] = random.bytes();
        in[2] = random.bytes();
        in[3] = random.direction();
      },
      [](auto in) { return dominant_decode(in[0], in[1], in[2].x, in[3]); });
}

}  // namespace
}  // namespace rnmbake
