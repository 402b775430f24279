// What defines functions of shaders/ that have no counterpart in C++.
#include "shader_runs.h"

#include <array>

namespace rnmbake {
namespace {

Vec3 scaled_by(const Vec3& a, const Vec3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Midpoints of even steps in z and azimuth: directions that stand for equal solid angles of the hemisphere.
std::vector<Vec3> hemisphere() {
  constexpr int rings = 128, sectors = 64;
  std::vector<Vec3> directions;
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const double z = (ring + 0.5) / rings, azimuth = 2 * pi * (sector + 0.5) / sectors;
      const double radius = std::sqrt(1 - z * z);
      directions.emplace_back(Vec3d(radius * std::cos(azimuth), radius * std::sin(azimuth), z));
    }
  }
  return directions;
}

/// The i-th coefficient alone decodes to the i-th function; h4_decode knows the first four.
std::vector<Vec3> h_function(int i, const std::vector<Vec3>& directions, const std::string& decode,
                             int count) {
  std::string arguments;
  for (int k = 0; k < count; ++k) arguments += k == i ? "vec3(1.0), " : "vec3(0.0), ";
  return gl_compute().run(glsl_of({"hbasis"}), "return " + decode + "(" + arguments + "at(0));", 1,
                          directions);
}

/// Habel and Wimmer's definition: integrals of products over the hemisphere are 1 or 0. The midpoint rule in
/// z is off by its second derivative times step^2 / 24, at most 6.2e-5 here (of h2).
TEST(HBasis, IsOrthonormalOverTheHemisphere) {
  const auto directions = hemisphere();
  for (const auto& [decode, count] : {std::pair("h4_decode", 4), std::pair("h6_decode", 6)}) {
    std::vector<std::vector<Vec3>> functions;
    for (int i = 0; i < count; ++i) functions.push_back(h_function(i, directions, decode, count));
    for (const auto& a : functions) {
      for (const auto& b : functions) {
        double sum = 0;
        for (std::size_t k = 0; k < directions.size(); ++k) sum += double(a[k].x) * b[k].x;
        EXPECT_NEAR(sum * 2 * pi / double(directions.size()), &a == &b ? 1 : 0, 1e-4) << decode;
      }
    }
  }
}

const std::string cube_of_six = "vec3 cube[6];\nfor (int i = 0; i < 6; ++i) cube[i] = at(i);\n";

TEST(AmbientCube, ReturnsASideAlongItsAxisAndAnEvenCubeEverywhere) {
  for (std::size_t side = 0; side < 6; ++side) {
    Vec3 axis(0);
    axis[static_cast<int>(side / 2)] = side % 2 == 0 ? 1.0F : -1.0F;
    expect_same(
        {{"ambient_cube"}, cube_of_six + "return ambient_cube_decode(cube, at(6));", 7},
        [&](auto& random, auto in) {
          for (Vec3& colour : in) colour = random.within(0, 5);
          in[6] = axis;
        },
        [&](auto in) { return in[side]; });
  }
  expect_same(
      {{"ambient_cube"}, cube_of_six + "return ambient_cube_decode(cube, at(6));", 7},
      [](auto& random, auto in) {
        std::ranges::fill(in, random.within(0, 5));
        in[6] = random.direction();
      },
      [](auto in) { return in[0]; });
}

TEST(Ahd, IsAmbientFromBehindAndAllOfTheLightFromTheFront) {
  const auto make = [](auto& random, auto in) {
    in[0] = random.within(0, 5);
    in[1] = random.within(0, 5);
    in[2] = random.direction();
  };
  expect_same({{"ahd"}, "return ahd_decode(at(0), at(1), at(2), at(2));", 3}, make,
              [](auto in) { return in[0] + in[1]; });
  expect_same({{"ahd"}, "return ahd_decode(at(0), at(1), at(2), -at(2));", 3}, make,
              [](auto in) { return in[0]; });
}

/// Directionality is the decode's own value for the mesh's normal, whose light is then the plain map's.
TEST(Dominant, ReturnsThePlainMapForTheNormalThatItWasMadeFor) {
  expect_same(
      {{"dominant"},
       "float w = dot(at(2), at(1) - 0.5) + 0.5;\nreturn dominant_decode(at(0), at(1), w, at(2));",
       3},
      [](auto& random, auto in) {
        in[0] = random.within(0, 5);
        in[2] = random.direction();
        in[1] = in[2] * 0.4F + random.within(0.5F, 0.6F);
      },
      [](auto in) { return in[0]; });
  expect_same(
      {{"dominant"}, "return at(0) + dominant_decode(at(0), vec3(0.5) + 0.5 * at(1), 1.0, -at(1));", 2},
      [](auto& random, auto in) {
        in[0] = random.within(0, 5);
        in[1] = random.direction();
      },
      [](auto in) { return in[0]; });
}

TEST(Engines, GodotsFourSlicesComeInTheOrderL0YZX) {
  const std::string source = shader_text(engine_named("godot"), {"sh2"});
  const std::array inputs{Vec3(2, 1, 0.5F), Vec3(0.6F, 0.55F, 0.5F), Vec3(0.5F, 0.52F, 0.45F),
                          Vec3(0.4F, 0.5F, 0.6F), Vec3(0.6F, 0, 0.8F)};
  const Vec3 light =
      gl_compute()
          .run(source, "return rnmbake_godot_lightmap(at(0), at(1), at(2), at(3), at(4));", 5, inputs)
          .front();
  const Vec3 half(0.5F);
  const Vec3 turned = (inputs[3] - half) * inputs[4].x + (inputs[2] - half) * inputs[4].z;
  const Vec3 wanted = inputs[0] + scaled_by(inputs[0], turned * 8.0F);  // L0 (1 + 4 n . (2t - 1))
  EXPECT_LT((light - wanted).length(), 1e-5F * wanted.length());
}

TEST(Engines, PlayCanvassPairReturnsThePlainMapForTheMeshesNormal) {
  const std::string source = shader_text(engine_named("playcanvas"), {"directions"});
  const std::array inputs{Vec3(2, 1, 0.5F), Vec3(0.5F, 0.4F, 0.1F), Vec3(0, 0.6F, 0.8F)};
  const Vec3 light = gl_compute()
                         .run(source, "return rnmbake_playcanvas_dir(at(0), at(1), at(2), at(2));", 3, inputs)
                         .front();
  EXPECT_LT((light - inputs[0]).length(), 1e-5F);
}

}  // namespace
}  // namespace rnmbake
