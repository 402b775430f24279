#include "encoding/dominant_direction.h"
#include "encoding/rnm.h"
#include "encoding/sh.h"
#include "shader_runs.h"

namespace rnmbake {
namespace {

/// Three colours of light and a normal above the surface.
void three_maps(RandomVectors& random, std::span<Vec3> in) {
  for (std::size_t i = 0; i < 3; ++i) in[i] = random.within(0, 10);
  in[3] = random.normal_above();
}

std::array<Vec3, 3> maps_of(std::span<const Vec3> in) {
  return {in[0], in[1], in[2]};
}

TEST(Decoders, RnmSquared) {
  expect_same({{"rnm"}, "return rnm_decode_squared(at(0), at(1), at(2), at(3));", 4}, three_maps,
              [](auto in) { return rnm_decode_squared(maps_of(in), in[3]); });
}

TEST(Decoders, RnmLinear) {
  expect_same({{"rnm"}, "return rnm_decode_linear(at(0), at(1), at(2), at(3));", 4}, three_maps,
              [](auto in) { return rnm_decode_linear(maps_of(in), in[3]); });
}

TEST(Decoders, RnmBasisThereAndBack) {
  expect_same(
      {{"rnm"}, "return rnm_dots(at(0));", 1}, [](auto& random, auto in) { in[0] = random.direction(); },
      [](auto in) {
        const auto basis = rnm_basis();
        return Vec3(in[0].dot(basis[0]), in[0].dot(basis[1]), in[0].dot(basis[2]));
      });
  expect_same(
      {{"rnm"}, "return rnm_sum(rnm_dots(at(0)));", 1},
      [](auto& random, auto in) { in[0] = random.direction(); }, [](auto in) { return in[0]; });
}

/// rnm_scaled_to_flat() of each colour, in maps of which none is 0.
std::array<Vec3, 3> scaled_to_flat(const std::array<Vec3, 3>& maps, const Vec3& flat) {
  std::array<Vec3, 3> scaled;
  for (int c = 0; c < 3; ++c) {
    const auto one = rnm_scaled_to_flat({maps[0][c], maps[1][c], maps[2][c]}, flat[c]);
    for (std::size_t i = 0; i < 3; ++i) scaled[i][c] = one[i];
  }
  return scaled;
}

TEST(Decoders, RnmScaledToFlatAsVrad) {
  expect_same(
      {{"rnm"},
       "return rnm_scale_to_flat(at(4), at(0), at(1), at(2)) *\n"
       "       rnm_decode_squared(at(0), at(1), at(2), at(3));",
       5},
      [](auto& random, auto in) {
        three_maps(random, in);
        in[4] = random.within(0, 10);
      },
      [](auto in) { return rnm_decode_squared(scaled_to_flat(maps_of(in), in[4]), in[3]); });
}

TEST(Decoders, Sh3) {
  const std::string nine = "vec3 sh[9];\nfor (int i = 0; i < 9; ++i) sh[i] = at(i);\n";
  const auto make = [](auto& random, auto in) {
    for (std::size_t i = 0; i < 9; ++i) in[i] = random.within(-3, 3);
    in[9] = random.direction();
  };
  const auto decoded = [](auto in, const Vec3& n) {
    const auto y = sh_basis(n);
    Vec3 light(0);
    for (std::size_t i = 0; i < 9; ++i)
      light += in[i] * (y[i] * sh_cosine_over_pi[i == 0 ? 0 : i < 4 ? 1 : 2]);
    return light;
  };
  expect_same({{"sh3"}, nine + "return sh3_decode(sh, at(9));", 10}, make,
              [&](auto in) { return decoded(in, in[9]); });
  expect_same({{"sh3", "tangent_space"},
               nine + "for (int i = 0; i < 9; ++i) sh[i] = sh3_flip_green(sh[i], i);\n"
                      "return sh3_decode(sh, tangent_flip_green(at(9)));",
               10},
              make, [&](auto in) { return decoded(in, in[9]); });
}

LinearLight linear_light(std::span<const Vec3> in) {
  const auto rgb = [](const Vec3& v) { return std::array<float, 3>{v.x, v.y, v.z}; };
  return fit_linear(rgb(in[3]), {rgb(in[0]), rgb(in[1]), rgb(in[2])});
}

/// Three maps, the flat one, a normal, and in the sixth's x how much is left of the light.
void four_maps(RandomVectors& random, std::span<Vec3> in) {
  for (std::size_t i = 0; i < 4; ++i) in[i] = random.within(0, 10);
  in[4] = random.normal_above();
  in[5] = random.within(0, 1);
}

const std::string fitted = "vec3 a, x, y, z;\nsh2_fit(at(3), at(0), at(1), at(2), a, x, y, z);\n";

TEST(Decoders, Sh2OfFourBakes) {
  expect_same({{"sh2", "lightmap_shadows"}, fitted + "return sh2_decode(a, x, y, z, at(4));", 6}, four_maps,
              [](auto in) {
                const LinearLight light = linear_light(in);
                return Vec3(light.at(0, in[4]), light.at(1, in[4]), light.at(2, in[4]));
              });
}

TEST(Decoders, DominantDirection) {
  expect_same({{"lightmap_shadows"}, fitted + "return dominant_direction(a, x, y, z);", 6}, four_maps,
              [](auto in) { return dominant_direction(linear_light(in)).value_or(Vec3(0)); });
}

TEST(Decoders, LightmapShadowed) {
  expect_same({{"lightmap_shadows"},
               fitted + "vec3 d = dominant_direction(a, x, y, z);\n"
                        "return lightmap_shadowed(a, x, y, z, d, at(4), at(5).x);",
               6},
              four_maps, [](auto in) {
                const LinearLight light = linear_light(in);
                const Vec3 d = dominant_direction(light).value_or(Vec3(0, 0, 1));
                const auto of = [&](std::size_t c) { return shadowed(light, c, d, in[4], in[5].x); };
                return Vec3(of(0), of(1), of(2));
              });
}

}  // namespace
}  // namespace rnmbake
