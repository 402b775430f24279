#include "encoding/rnm.h"
#include "pipeline/ssbump/decode_ssbump.h"
#include "shader_runs.h"
#include "ssbump/map/combine.h"
#include "ssbump/map/encode.h"
#include "ssbump/map/normals.h"
#include "ssbump/map/weights.h"

#include <algorithm>

namespace rnmbake {
namespace {

/// One texel: the weights of three axes, straight up, and 1 of ambient occlusion.
FloatImage weights_texel(const Vec3& w, float up = 1) {
  FloatImage weights(1, 1, SsbumpWeights::channels);
  std::ranges::copy(std::array{w.x, w.y, w.z, up, 1.0F}, weights.data().begin());
  return weights;
}

FloatImage colour_texel(const Vec3& colour) {
  FloatImage image(1, 1, 3);
  std::ranges::copy(std::array{colour.x, colour.y, colour.z}, image.data().begin());
  return image;
}

Vec3 first_texel(const FloatImage& image) {
  return {image.data()[0], image.data()[1], image.data()[2]};
}

/// What decode_ssbump() makes of a case: weights (1 is open), three maps, up in the fifth vector's x.
Vec3 decoded(std::span<const Vec3> in, SsbumpAlpha alpha) {
  Lightmap lightmap;
  lightmap.metadata.bases = rnm_set().directions;
  for (std::size_t i = 0; i < 3; ++i) lightmap.layers.emplace(rnm_layers[i], colour_texel(in[i + 1]));
  SsbumpPicture picture{weights_texel(in[0], in[4].x), {}, true, ""};
  picture.metadata.alpha = alpha;
  return first_texel(decode_ssbump(std::move(lightmap), picture, DecodeVariant::squared));
}

void weights_and_maps(RandomVectors& random, std::span<Vec3> in) {
  in[0] = random.within(0, 1.7F);
  for (std::size_t i = 1; i < 4; ++i) in[i] = random.within(0, 10);
  in[4] = random.within(0, 1);
}

TEST(SsbumpShader, Decode) {
  expect_same({{"ssbump"}, "return ssbump_decode(at(0) / 3.0, at(1), at(2), at(3));", 5}, weights_and_maps,
              [](auto in) { return decoded(in, SsbumpAlpha::none); });
}

TEST(SsbumpShader, DecodeWithTheFourthChannel) {
  expect_same({{"ssbump"}, "return ssbump_decode4(at(0) / 3.0, at(4).x, at(1), at(2), at(3));", 5},
              weights_and_maps, [](auto in) { return decoded(in, SsbumpAlpha::up); });
}

/// Of 8 bits: the same bytes on both sides.
TEST(SsbumpShader, EveryScaleAndHandOfAFile) {
  const auto bytes = [](auto& random, auto in) { in[0] = random.bytes(); };
  for (const auto scale : {SsbumpScale::third, SsbumpScale::ndotb, SsbumpScale::mod2x}) {
    const std::string third = "ssbump_to_third(at(0), " + std::to_string(flat_value(scale)) + ")";
    for (const auto handed : {Handed::right, Handed::left}) {
      const bool left = handed == Handed::left;
      expect_same({{"ssbump"}, "return " + (left ? "ssbump_flip_hand(" + third + ")" : third) + ";", 1},
                  bytes, [&](auto in) {
                    const SsbumpEncoding encoding{scale, handed, SsbumpAlpha::none};
                    return first_texel(decode_weights(colour_texel(in[0]), encoding)) / 3.0F;
                  });
    }
  }
}

TEST(SsbumpShader, BentNormal) {
  expect_same(
      {{"ssbump"}, "return ssbump_bent_normal(at(0) / 3.0);", 1},
      [](auto& random, auto in) { in[0] = random.within(0, 1.7F); },
      [](auto in) { return first_texel(bent_normals(weights_texel(in[0]))); });
  const std::array dark{Vec3(0)};
  EXPECT_EQ(gl_compute().run(glsl_of({"ssbump"}), "return ssbump_bent_normal(at(0));", 1, dark).front(),
            Vec3(0, 0, 1));
}

/// sat(sum of s_i dot(l, B_i)) by the basis of encoding/rnm.h, 1 in the open for a light straight above.
float dynamic_light(const Vec3& weights, const Vec3& light) {
  const auto basis = rnm_basis();
  float sum = 0;
  for (int i = 0; i < 3; ++i) sum += weights[i] / 3 * light.dot(basis[static_cast<std::size_t>(i)]);
  return std::clamp(sum / basis[0].z, 0.0F, 1.0F);
}

void weights_and_light(RandomVectors& random, std::span<Vec3> in) {
  in[0] = random.within(0, 1);
  in[1] = random.normal_above();
}

TEST(SsbumpShader, DynamicLight) {
  expect_same({{"ssbump"}, "return vec3(ssbump_light(at(0) / 3.0, at(1)), 0.0, 0.0);", 2}, weights_and_light,
              [](auto in) { return Vec3(dynamic_light(in[0], in[1]), 0, 0); });
}

/// Seen from where the bent normal mirrors the light to, the highlight is all of the light.
TEST(SsbumpShader, SpecularAboutTheBentNormal) {
  expect_same(
      {{"ssbump"},
       "vec3 n = ssbump_bent_normal(at(0) / 3.0);\n"
       "vec3 eye = 2.0 * dot(n, at(1)) * n - at(1);\n"
       "return vec3(ssbump_specular(at(0) / 3.0, at(1), eye, 8.0), 0.0, 0.0);",
       2},
      [](auto& random, auto in) {
        in[0] = random.within(0.5F, 1);
        const Vec3 l = random.normal_above();
        in[1] = unit({l.x, l.y, l.z + 2});  // on the bright side of every such normal
      },
      [](auto in) { return Vec3(dynamic_light(in[0], in[1]), 0, 0); });
}

TEST(SsbumpShader, DetailIsEvenAndLeavesTheBentNormal) {
  const auto make = [](auto& random, auto in) {
    in[0] = random.within(0, 1);
    in[1] = random.within(0, 1);
  };
  expect_same({{"ssbump"}, "return ssbump_detail(at(0) / 3.0, at(1) / 3.0);", 2}, make, [](auto in) {
    FloatImage weights = weights_texel(in[0]);
    combine_detail(weights, weights_texel(in[1]), 1, Combine::even);
    return first_texel(weights) / 3.0F;
  });
  expect_same({{"ssbump"}, "return ssbump_bent_normal(ssbump_detail(at(0), at(1)));", 2}, make,
              [](auto in) { return first_texel(bent_normals(weights_texel(in[0]))); });
}

/// Two maps, then a case as above: the light of the blend is the blend of both lights.
TEST(SsbumpShader, BlendedMapsGiveBlendedLight) {
  expect_same(
      {{"ssbump"},
       "return ssbump_decode(ssbump_blend(at(0), at(5), at(4).x) / 3.0, at(1), at(2), at(3));",
       6},
      [](auto& random, auto in) {
        weights_and_maps(random, in);
        in[5] = random.within(0, 1);
      },
      [](auto in) {
        std::vector<Vec3> other(in.begin(), in.end());
        other[0] = in[5];
        const Vec3 a = decoded(in, SsbumpAlpha::none), b = decoded(other, SsbumpAlpha::none);
        return a + (b - a) * in[4].x;
      });
}

}  // namespace
}  // namespace rnmbake
