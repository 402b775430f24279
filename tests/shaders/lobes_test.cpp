#include "encoding/geomerics.h"
#include "encoding/sh2.h"
#include "encoding/zh3.h"
#include "shader_runs.h"

namespace rnmbake {
namespace {

using Decode = float (*)(float a, const Vec3& v, const Vec3& normal);

/// Of layers l0, l1x, l1y, l1z.
Vec3 decoded(Decode decode, const Vec3& l0, const std::array<Vec3, 3>& l1, const Vec3& normal) {
  const auto of = [&](int c) { return decode(l0[c], {l1[0][c], l1[1][c], l1[2][c]}, normal); };
  return {of(0), of(1), of(2)};
}

struct NamedDecode {
  const char* name;  // of the shader file, and before "_decode" in its functions
  Decode decode;
};

class LobeShader : public testing::TestWithParam<NamedDecode> {
 protected:
  std::string call(const std::string& prefix, const std::string& arguments) {
    return "return " + prefix + GetParam().name + "_decode(" + arguments + ");";
  }
  void expect(const std::string& body, std::size_t width, const MakeCase& make, const OfCase& expected) {
    expect_same({{"sh2", GetParam().name}, body, width}, make, expected);
  }
};

/// |v| up to twice 2 a, in every direction.
TEST_P(LobeShader, Floats) {
  expect(
      call("", "at(0), at(1), at(2), at(3), at(4)"), 5,
      [](auto& random, auto in) {
        in[0] = random.within(0.5F, 4);
        for (std::size_t i = 1; i < 4; ++i) in[i] = random.within(-4, 4);
        in[4] = random.direction();
      },
      [](auto in) {
        return decoded(GetParam().decode, in[0], {in[1], in[2], in[3]}, in[4]);
      });
}

/// Darkness, light without a direction, and a below 0, which fits may have.
TEST_P(LobeShader, Limits) {
  expect(
      call("", "at(0), at(1), at(2), at(3), at(4)"), 5,
      [](auto& random, auto in) {
        in[0] = {0, 1, -1};
        for (std::size_t i = 1; i < 4; ++i) in[i] = {0, 0, random.within(-1, 1).x};
        in[4] = random.direction();
      },
      [](auto in) {
        return decoded(GetParam().decode, in[0], {in[1], in[2], in[3]}, in[4]);
      });
}

/// The same bytes on both sides: t = 1/2 + v / (2 K a).
TEST_P(LobeShader, PackedInBytes) {
  for (const float range : {2.0F, 4.0F}) {
    const auto unpacked = [&](const Vec3& l0, const Vec3& t) {
      return Vec3(l0.x * (2 * t.x - 1), l0.y * (2 * t.y - 1), l0.z * (2 * t.z - 1)) * range;
    };
    const auto axis = [&](int i) {
      return fmt::format("packed_sh2_unpack(at(0), at({}), {:.1f})", i, range);
    };
    expect(
        call("", fmt::format("at(0), {}, {}, {}, at(4)", axis(1), axis(2), axis(3))), 5,
        [](auto& random, auto in) {
          in[0] = random.within(0.1F, 10);
          for (std::size_t i = 1; i < 4; ++i) in[i] = random.bytes();
          in[4] = random.direction();
        },
        [&](auto in) {
          const auto v = [&](std::size_t i) { return unpacked(in[0], in[i]); };
          return decoded(GetParam().decode, in[0], {v(1), v(2), v(3)}, in[4]);
        });
  }
}

/// One direction map: every colour has the direction of the luminance, in proportion to its own a.
TEST_P(LobeShader, MonoInBytes) {
  expect(
      call("mono_", "at(0), at(1), 2.0, at(2)"), 3,
      [](auto& random, auto in) {
        in[0] = random.within(0.1F, 10);
        in[1] = random.bytes();
        in[2] = random.direction();
      },
      [](auto in) {
        const Vec3 v = (in[1] * 2.0F - Vec3(1)) * 2.0F;
        return in[0] * GetParam().decode(1, v, in[2]);
      });
}

INSTANTIATE_TEST_SUITE_P(Decoders, LobeShader,
                         testing::Values(NamedDecode{"sh2", sh2_decode}, NamedDecode{"zh3", zh3_decode},
                                         NamedDecode{"geomerics", geomerics_decode}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace rnmbake
