// What codecs of src/encoding/ write, decoded by shader and by codec.
#include "encoding/basis_set.h"
#include "encoding/codecs/make_codec.h"
#include "shader_runs.h"

#include <algorithm>

namespace rnmbake {
namespace {

struct CodecShader {
  CodecOptions options;
  std::string shader;
  std::string call;  // a function and all arguments but the layers, which at(0), at(1), ... stand for, and n
};

/// A few far lights and an even sky: E/pi at each direction of the set.
std::vector<Vec3> lit(RandomVectors& random, const BasisSet& set) {
  std::vector<Vec3> irradiance(set.directions.size(), Vec3(0));
  const Vec3 sky = random.within(0.1F, 1);
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    irradiance[i] = sky * ((1 + set.directions[i].direction.z) / 2);
  for (int light = 0; light < 3; ++light) {
    const Vec3 towards = random.normal_above(), colour = random.within(0, 2);
    for (std::size_t i = 0; i < irradiance.size(); ++i)
      irradiance[i] += colour * std::max(0.0F, towards.dot(set.directions[i].direction));
  }
  return irradiance;
}

class CodecShaders : public testing::TestWithParam<CodecShader> {};

TEST_P(CodecShaders, DecodeAsTheCodecDoes) {
  const BasisSet set = flat_and_rnm();
  const auto codec = make_codec(GetParam().options, set);
  const std::size_t layers = codec->layers().size();
  expect_same(
      {{GetParam().shader},
       "vec3 n = at(" + std::to_string(layers) + ");\nreturn " + GetParam().call + ";",
       layers + 1},
      [&](auto& random, auto in) {
        (void)codec->encode(lit(random, set), in.first(layers));
        in[layers] = random.normal_above();
      },
      [&](auto in) { return codec->decode(in.first(layers), in[layers]); });
}

/// A lobe's decode of layers packed with K, one direction map for all colours or one for each.
CodecShader packed(const char* name, int range, int bits, bool mono) {
  CodecOptions options;
  options.name = name;
  options.range = range;
  options.bits = bits;
  options.mono = mono;
  const auto axis = [&](int i) { return fmt::format("packed_sh2_unpack(at(0), at({}), {}.0)", i, range); };
  return {options, name,
          mono ? fmt::format("mono_{}_decode(at(0), at(1), {}.0, n)", name, range)
               : fmt::format("{}_decode(at(0), {}, {}, {}, n)", name, axis(1), axis(2), axis(3))};
}

std::string test_name(const testing::TestParamInfo<CodecShader>& one) {
  const CodecOptions& options = one.param.options;
  std::string name = options.name;
  if (options.range > 0) name += fmt::format("_{}_in_{}_bits", options.range, options.bits);
  if (options.mono) name += "_mono";
  std::ranges::replace(name, '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Encodings, CodecShaders,
    testing::Values(CodecShader{{"rnm"}, "rnm", "rnm_decode_squared(at(0), at(1), at(2), n)"},
                    CodecShader{{"rnm-vrad"}, "rnm", "rnm_decode_squared(at(0), at(1), at(2), n)"},
                    CodecShader{{"rnm-bakery"}, "rnm", "rnm_decode_linear(at(0), at(1), at(2), n)"},
                    CodecShader{{"sh2"}, "sh2", "sh2_decode(at(0), at(1), at(2), at(3), n)"},
                    CodecShader{{"zh3"}, "zh3", "zh3_decode(at(0), at(1), at(2), at(3), n)"},
                    CodecShader{
                        {"geomerics"}, "geomerics", "geomerics_decode(at(0), at(1), at(2), at(3), n)"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(Packings, CodecShaders,
                         testing::Values(packed("sh2", 2, 8, false), packed("sh2", 4, 16, false),
                                         packed("sh2", 2, 8, true), packed("zh3", 2, 8, false),
                                         packed("zh3", 2, 8, true), packed("geomerics", 4, 0, false),
                                         packed("geomerics", 2, 8, true)),
                         test_name);

}  // namespace
}  // namespace rnmbake
