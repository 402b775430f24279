#include "ssbump/normal_shadows/normal_shadows.h"

#include "shader_runs.h"
#include "ssbump/nms_support.h"

#include <cstdint>
#include <optional>

namespace rnmbake {
namespace {

constexpr int width = 64, height = 32, steps = 32;

/// Unit normals as a normal map stores them.
FloatImage packed(FloatImage normals, bool y_down) {
  pack_normals(normals, y_down);
  return normals;
}

/// What light_left() takes as a texel's random part of a step: PCG's output function as a hash.
float random_part(int x, int y, std::uint32_t seed) {
  const auto hash = [](std::uint32_t value) {
    const std::uint32_t state = value * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
  };
  return static_cast<float>(hash(std::uint32_t(x) + hash(std::uint32_t(y) + hash(seed))) >> 8U) * 0x1p-24F;
}

/// UVs of every texel's centre, v running down, and its jitter.
std::vector<Vec3> texel_places(std::optional<std::uint32_t> seed = {}) {
  std::vector<Vec3> places;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      places.emplace_back((static_cast<float>(x) + 0.5F) / width, (static_cast<float>(y) + 0.5F) / height,
                          seed ? random_part(x, y, *seed) : 0);
  return places;
}

std::string text_of(const Vec3& v) {
  return fmt::format("vec3({:.9f}, {:.9f}, {:.9f})", v.x, v.y, v.z);
}

/// The arguments that stand for `options`: the walk, in UVs whose v runs down.
std::string walk_of(const NormalShadowOptions& options) {
  return fmt::format("vec2({:.9f}, {:.9f})", options.length, -options.length * width / height);
}

/// The sum jumps where it passes a threshold. Which side rounding falls on is nobody's mistake: texels whose
/// share changes as the light turns by a ten-thousandth are left out, and counted.
struct Steady {
  float left = 1;
  bool is_steady = true;
};

Steady steady_left(const FloatImage& normals, int x, int y, const Vec3& light,
                   const NormalShadowOptions& options) {
  Steady result{light_left(normals, x, y, light, options), true};
  for (const Vec3& turn : {Vec3(1e-4F, 0, 0), Vec3(0, 1e-4F, 0), Vec3(0, 0, 1e-4F)})
    for (const Vec3& other : {unit(light + turn), unit(light - turn)})
      result.is_steady &= std::abs(light_left(normals, x, y, other, options) - result.left) < 1e-5F;
  return result;
}

/// Holds each of `columns` columns against light_left().
void expect_shares(const std::vector<Vec3>& shares, const FloatImage& normals, const Vec3& light,
                   const NormalShadowOptions& options, int columns = width) {
  int unsteady = 0, shadowed = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Steady wanted = steady_left(normals, x, y, light, options);
      unsteady += wanted.is_steady ? 0 : 1;
      shadowed += wanted.left < 0.9F ? 1 : 0;
      if (!wanted.is_steady) continue;
      ASSERT_NEAR(shares[std::size_t(y * width + x)].x, wanted.left, 1e-5F) << x << ", " << y;
    }
  }
  EXPECT_LT(unsteady, columns * height / 50);
  EXPECT_GT(shadowed, columns * height / 50);
}

class NormalShadowShader : public testing::TestWithParam<Vec3> {
 protected:
  std::vector<Vec3> run(const std::string& call, const std::string& shader,
                        std::optional<std::uint32_t> seed = {}) {
    return gl_compute().run(glsl_of({shader}), "return vec3(" + call + ", 0.0, 0.0);", 1, texel_places(seed));
  }
  FloatImage normals_ = normals_of_field(waves(width, height, 3));
};

TEST_P(NormalShadowShader, Soft) {
  const Vec3 light = GetParam();
  const NormalShadowOptions options{.length = 0.22F, .steps = steps};
  for (const bool y_down : {false, true}) {
    gl_compute().add_texture("normal_texture", packed(normals_, y_down));
    expect_shares(run(fmt::format("normal_shadow(normal_texture, at(0).xy, {}, {}, {}, {}, {:.9f}, 0.0)",
                                  y_down ? "-1.0" : "1.0", text_of(light), walk_of(options), steps,
                                  options.hardness_used()),
                      "normal_shadows"),
                  normals_, light, options);
  }
}

TEST_P(NormalShadowShader, Jittered) {
  const Vec3 light = GetParam();
  const NormalShadowOptions options{.length = 0.22F, .steps = 8, .jitter = 5};
  gl_compute().add_texture("normal_texture", packed(normals_, false));
  expect_shares(run(fmt::format("normal_shadow(normal_texture, at(0).xy, 1.0, {}, {}, 8, {:.9f}, at(0).z)",
                                text_of(light), walk_of(options), options.hardness_used()),
                    "normal_shadows", 5),
                normals_, light, options);
}

TEST_P(NormalShadowShader, Hard) {
  const Vec3 light = GetParam();
  const NormalShadowOptions options{.length = 0.22F, .steps = steps, .hard = true};
  gl_compute().add_texture("normal_texture", packed(normals_, false));
  expect_shares(run(fmt::format("normal_shadow_hard(normal_texture, at(0).xy, 1.0, {}, {}, {}, 0.0)",
                                text_of(light), walk_of(options), steps),
                    "normal_shadows"),
                normals_, light, options);
}

/// One depth all over: what is shadowed is what the forward shader shadows.
TEST_P(NormalShadowShader, DeferredOverOneSurface) {
  const Vec3 light = GetParam();
  const NormalShadowOptions options{.length = 0.22F, .steps = steps};
  gl_compute().add_texture("normal_texture", packed(normals_, false));
  gl_compute().add_texture("depth_texture", even_normals(width, height, {1, 0, 0}));
  expect_shares(run(fmt::format("normal_shadow_deferred(normal_texture, depth_texture, at(0).xy, {}, {}, "
                                "0.5, {}, {:.9f}, 0.0)",
                                text_of(light), walk_of(options), steps, options.hardness_used()),
                    "normal_shadows_deferred"),
                normals_, light, options);
}

INSTANTIATE_TEST_SUITE_P(Lights, NormalShadowShader,
                         testing::Values(light_from(20, 25), light_from(110, 35), light_from(-75, 15),
                                         light_from(200, 20)));

/// The right part of the picture lies behind by `gap`, with a range of 0.5. Steps of one texel, so that no
/// lookup mixes both parts. To the sum that is a surface whose cosines there are scaled by 1 - gap / 0.5.
TEST(NormalShadowDeferred, StepsCountByTheirDepth) {
  constexpr int edge = 24;
  const Vec3 light = light_from(0, 20);
  const NormalShadowOptions options{.length = steps / (width * light.x), .steps = steps};
  const FloatImage normals = normals_of_field(waves(width, height, 3));
  for (const float gap : {0.25F, 0.75F}) {
    FloatImage depths = even_normals(width, height, {1, 0, 0}), scaled = normals;
    for (int y = 0; y < height; ++y) {
      for (int x = edge; x < width; ++x) {
        depths.texel(x, y)[0] += gap;
        const auto n = scaled.texel(x, y);
        const float taken = std::min(gap / 0.5F, 1.0F) * light.dot({n[0], n[1], n[2]});
        for (int c = 0; c < 3; ++c) n[std::size_t(c)] -= taken * light[c];
      }
    }
    gl_compute().add_texture("normal_texture", packed(normals, false));
    gl_compute().add_texture("depth_texture", depths);
    const auto shares = gl_compute().run(
        glsl_of({"normal_shadows_deferred"}),
        fmt::format(
            "return vec3(normal_shadow_deferred(normal_texture, depth_texture, at(0).xy, {}, {}, 0.5, "
            "{}, {:.9f}, 0.0), 0.0, 0.0);",
            text_of(light), walk_of(options), steps, options.hardness_used()),
        1, texel_places());
    expect_shares(shares, scaled, light, options, edge);
  }
}

TEST(FakeSpecular, IsTheCubeTimesTheLightAndNothingInTheDark) {
  expect_same(
      {{"fake_specular"}, "return fake_specular(at(0), at(1), 0.0, 1e-6);", 2},
      [](auto& random, auto in) {
        in[0] = random.within(0, 4);
        in[1] = random.within(0.1F, 4);
      },
      [](auto in) { return in[0] * in[1]; });
  expect_same(
      {{"fake_specular"}, "return at(0) + fake_specular(at(0), at(1), 4.0, 5.0);", 2},
      [](auto& random, auto in) {
        in[0] = random.within(0, 4);
        in[1] = random.within(0, 4);
      },
      [](auto in) { return in[0]; });
  expect_same(
      {{"fake_specular"}, "return fake_specular_direction(at(0), at(1)) + at(0);", 2},
      [](auto& random, auto in) {
        in[0] = random.direction();
        in[1] = random.direction();
      },
      [](auto in) { return in[1] * (2 * in[0].dot(in[1])); });
}

TEST(TangentSpace, UnpacksNormalMaps) {
  const auto normal = [](auto& random, auto in) { in[0] = random.normal_above(); };
  expect_same(
      {{"tangent_space"}, "return normal_map_unpack(0.5 + 0.5 * tangent_flip_green(at(0)), -1.0);", 1},
      normal, [](auto in) { return in[0]; });
  expect_same(
      {{"tangent_space"}, "return normal_map_unpack2(0.5 + 0.5 * at(0).xy, 1.0);", 1},
      [](auto& random, auto in) {
        const Vec3 n = random.normal_above();
        in[0] = unit({n.x, n.y, n.z + 0.5F});  // rounding of x and y grows by 1/z
      },
      [](auto in) { return in[0]; });
}

TEST(TangentSpace, ToTheWorldAlongTheMeshesOwnAxes) {
  expect_same(
      {{"tangent_space"},
       "vec3 n = normalize(at(1));\nvec3 t = normalize(cross(n, at(2)));\n"
       "vec3 w = tangent_to_world(at(0), t, -1.0, n);\n"
       "return vec3(dot(w, t), -dot(w, cross(n, t)), dot(w, n));",
       3},
      [](auto& random, auto in) {
        for (Vec3& v : in) v = random.direction();
      },
      [](auto in) { return in[0]; });
}

}  // namespace
}  // namespace rnmbake
