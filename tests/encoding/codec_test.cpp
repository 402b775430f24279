#include "encoding/codec.h"

#include "base/error.h"
#include "encoding/codecs/make_codec.h"
#include "encoding/direction_sets.h"
#include "encoding/random_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

struct Encoded {
  std::vector<Vec3> layers;
  EncodeCounts counts;
};

Encoded encoded(const Codec& codec, const std::vector<Vec3>& irradiance, const TexelFrame& frame = {}) {
  Encoded result{std::vector<Vec3>(codec.layers().size(), Vec3(-1)), {}};
  result.counts = codec.encode(irradiance, result.layers, frame);
  return result;
}

/// The directions that feed every encoding.
BasisSet all_directions() {
  return direction_set("sh3").value();
}

std::vector<std::unique_ptr<const Codec>> all_codecs() {
  std::vector<std::unique_ptr<const Codec>> codecs;
  for (const std::string& name : codec_names()) codecs.push_back(make_codec({name}, all_directions()));
  for (const char* name : {"sh2", "zh3", "geomerics"}) {
    for (const bool mono : {false, true}) codecs.push_back(make_codec({name, 2, 0, mono}, all_directions()));
  }
  return codecs;
}

float greatest_error(const Vec3& a, const Vec3& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

bool is_finite(const std::vector<Vec3>& values) {
  return std::ranges::all_of(
      values, [](const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); });
}

std::string refusal(const CodecOptions& options, const BasisSet& set, ExitCode code) {
  try {
    (void)make_codec(options, set);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  return "accepted";
}

TEST(Codec, RefusesWhatItCannotBeFed) {
  EXPECT_NE(refusal({"shh"}, flat_and_rnm(), ExitCode::usage).find("choose one of flat, rnm, "),
            std::string::npos);
  EXPECT_NE(refusal({"zh3"}, rnm_set(), ExitCode::unsupported).find("needs the bake 'flat'"),
            std::string::npos);
  BasisSet y_down = flat_and_rnm();
  std::swap(y_down.directions[2].direction, y_down.directions[3].direction);
  EXPECT_NE(refusal({"rnm"}, y_down, ExitCode::unsupported).find("needs the bake 'rnm1'"), std::string::npos);
  EXPECT_EQ(refusal({"rnm"}, rnm_set(), ExitCode::ok), "accepted");
  const std::string too_few = refusal({"h6"}, flat_and_rnm(), ExitCode::unsupported);
  EXPECT_NE(too_few.find("bake --basis-set h6"), std::string::npos) << too_few;
  // Ten directions, but on rings that leave band 2 open.
  EXPECT_NE(refusal({"sh3"}, *direction_set("h6"), ExitCode::unsupported).find("bake --basis-set sh3"),
            std::string::npos);
}

TEST(Codec, RefusesPackingsThatDoNotExist) {
  const auto message = [](const CodecOptions& options) {
    return refusal(options, flat_and_rnm(), ExitCode::usage);
  };
  EXPECT_NE(message({"rnm", 2}).find("has no range"), std::string::npos);
  EXPECT_NE(message({"zh3", -1}).find("give 2, 4, or 0"), std::string::npos);
  EXPECT_NE(message({"zh3", std::numeric_limits<float>::quiet_NaN()}).find("give 2, 4, or 0"),
            std::string::npos);
  EXPECT_NE(message({"sh2", 0, 8}).find("without a range"), std::string::npos);
  EXPECT_NE(message({"sh2", 0, 0, true}).find("without a range"), std::string::npos);
  EXPECT_NE(message({"sh2", 2, 10}).find("give 8, 16"), std::string::npos);
}

TEST(Codec, FindsTheDirectionsInAnyOrder) {
  std::mt19937 random(1);
  const Hemisphere light = random_hemisphere(random);
  const BasisSet set = all_directions();
  BasisSet turned = set;
  std::ranges::reverse(turned.directions);
  for (const std::string& name : codec_names()) {
    const auto forward = make_codec({name}, set), backward = make_codec({name}, turned);
    const auto a = encoded(*forward, bakes(light, set)).layers,
               b = encoded(*backward, bakes(light, turned)).layers;
    const Vec3 normal = Vec3(1, 2, 3).normalized();
    EXPECT_LE(greatest_error(forward->decode(a, normal), backward->decode(b, normal)),
              1e-5F * max_channel(a[0]))
        << name;
  }
}

TEST(Codec, KeepsTheFlatBake) {
  std::mt19937 random(6);
  const BasisSet set = all_directions();
  for (int i = 0; i < 50; ++i) {
    const auto light =
        bakes(random_hemisphere(random), random_hemisphere(random), random_hemisphere(random), set);
    for (const std::string& name : codec_names()) {
      if (name == "rnm" || name == "rnm-bakery") continue;  // do not, by definition
      const auto codec = make_codec({name}, set);
      const auto layers = encoded(*codec, light).layers;
      EXPECT_LE(greatest_error(codec->decode(layers, {0, 0, 1}), light[0]), 1e-5F * max_channel(light[0]))
          << name;
    }
  }
}

TEST(Codec, ReturnsTheBakes) {
  std::mt19937 random(2);
  const BasisSet set = flat_and_rnm();
  for (int i = 0; i < 100; ++i) {
    const auto light =
        bakes(random_hemisphere(random), random_hemisphere(random), random_hemisphere(random), set);
    const float greatest = max_channel(*std::ranges::max_element(light, {}, max_channel));
    for (const std::string name : {"sh2", "zh3", "geomerics"}) {
      const auto codec = make_codec({name}, set);
      const auto [layers, counts] = encoded(*codec, light);
      if (counts.unconverged > 0) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_LE(greatest_error(codec->decode(layers, set.directions[k].direction), light[k]),
                  1e-5F * greatest)
            << name;
      }
    }
  }
}

TEST(Codec, UniformSky) {
  const BasisSet set = flat_and_rnm();
  std::vector<Vec3> sky;
  for (const BasisDirection& basis : set.directions) sky.emplace_back((1 + basis.direction.z) / 2);
  const auto decoded = [&](const std::string& name, const Vec3& normal) {
    const auto codec = make_codec({name}, set);
    return codec->decode(encoded(*codec, sky).layers, normal).x;
  };
  const Vec3 up(0, 0, 1);
  EXPECT_NEAR(decoded("flat", {1, 0, 0}), 1, 1e-6);
  EXPECT_NEAR(decoded("rnm", up), 0.78867513, 1e-6);
  EXPECT_NEAR(decoded("rnm-vrad", up), 1, 1e-6);
  EXPECT_NEAR(decoded("rnm-bakery", up), std::sqrt(3) * 0.78867513, 1e-6);
  for (const float tilt : {0.0F, 0.5F, 1.0F, 1.5F})
    EXPECT_NEAR(decoded("sh2", {std::sin(tilt), 0, std::cos(tilt)}), (1 + std::cos(tilt)) / 2, 1e-6);
}

TEST(Codec, ASunAboveAllHorizonsIsLinear) {
  const BasisSet set = flat_and_rnm();
  const Vec3d towards = Vec3d(0.1, 0.2, 1).normalized();
  const auto codec = make_codec({"sh2"}, set);
  const auto layers = encoded(*codec, bakes({{towards, 1}}, set)).layers;
  EXPECT_NEAR(layers[0].x, 0, 1e-6);
  EXPECT_NEAR(codec->decode(layers, Vec3(towards)).x, 1, 1e-6);
}

TEST(Codec, ScalesWithTheLight) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const auto light = bakes(random_hemisphere(random), all_directions());
    std::vector<Vec3> brighter;
    for (const Vec3& value : light) brighter.push_back(value * 1024);
    const Vec3 normal(random_direction(random));
    for (const auto& codec : all_codecs()) {
      const Vec3 once = codec->decode(encoded(*codec, light).layers, normal) * 1024;
      const Vec3 later = codec->decode(encoded(*codec, brighter).layers, normal);
      EXPECT_LE(greatest_error(once, later), 1e-5F * max_channel(brighter[0])) << codec->layers().back();
    }
  }
}

TEST(Codec, AllButRefitsAreLinearInTheLight) {
  std::mt19937 random(4);
  const BasisSet set = all_directions();
  for (int i = 0; i < 50; ++i) {
    const auto a = bakes(random_hemisphere(random), set), b = bakes(random_hemisphere(random), set);
    std::vector<Vec3> both;
    for (std::size_t k = 0; k < a.size(); ++k) both.push_back(a[k] + b[k]);
    const Vec3 normal(random_direction(random));
    for (const char* name : {"flat", "rnm", "rnm-bakery", "rnm-signed", "sh2", "sh3", "h4", "h6", "sg"}) {
      const auto codec = make_codec({name}, set);
      const auto decoded = [&](const auto& light) {
        return codec->decode(encoded(*codec, light).layers, normal);
      };
      EXPECT_LE(greatest_error(decoded(both), decoded(a) + decoded(b)), 1e-5F * max_channel(both[0])) << name;
    }
  }
}

TEST(Codec, TurnsWithTheWorld) {
  std::mt19937 random(5);
  const auto light = bakes(random_hemisphere(random), random_hemisphere(random), random_hemisphere(random),
                           all_directions());
  for (int i = 0; i < 50; ++i) {
    TexelFrame frame;
    frame.normal = Vec3(random_direction(random));
    frame.tangent = frame.normal.cross(Vec3(random_direction(random))).normalized();
    frame.bitangent = frame.normal.cross(frame.tangent) * (i % 2 == 0 ? 1.0F : -1.0F);  // mirrored UVs too
    const Vec3 normal(random_direction(random));
    for (const auto& codec : all_codecs()) {
      if (!codec->can_rotate()) continue;
      const Encoded untouched = encoded(*codec, light), turned = encoded(*codec, light, frame);
      // The range's box follows the axes of the space; within it, nothing does.
      if (untouched.counts.out_of_range + turned.counts.out_of_range > 0) continue;
      const Vec3 in_tangent_space = codec->decode(untouched.layers, normal);
      const Vec3 in_world = codec->decode(turned.layers, frame.stored(normal));
      EXPECT_LE(greatest_error(in_tangent_space, in_world), 1e-5F * max_channel(light[0]))
          << codec->layers().back();
    }
  }
}

TEST(Codec, IsAlwaysFinite) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::array<float, 9> values{0, -1, 1, 1e-38F, 1e9F, 1e30F, 3e38F, nan, inf};
  for (const auto& codec : all_codecs()) {
    for (const float odd : values) {
      for (const float rest : values) {
        for (std::size_t at = 0; at < 4; ++at) {
          std::vector<Vec3> light(all_directions().directions.size(), Vec3(rest));
          light[at] = Vec3(odd);
          const auto [layers, counts] = encoded(*codec, light);
          EXPECT_TRUE(is_finite(layers)) << codec->layers().back() << ' ' << odd << ' ' << rest << ' ' << at;
          EXPECT_EQ(counts.texels, 1U);
          EXPECT_EQ(counts.non_finite, (std::abs(odd) <= 1e30F && std::abs(rest) <= 1e30F) ? 0U : 1U);
          const Vec3 decoded = codec->decode(layers, {0, 0.6F, 0.8F});
          EXPECT_FALSE(std::isnan(decoded.x)) << codec->layers().back() << ' ' << odd << ' ' << rest;
        }
      }
    }
  }
}

TEST(Codec, DarknessStaysDark) {
  for (const auto& codec : all_codecs()) {
    const auto [layers, counts] =
        encoded(*codec, std::vector<Vec3>(all_directions().directions.size(), Vec3(0)));
    EXPECT_EQ(codec->decode(layers, {0, 0.6F, 0.8F}), Vec3(0));
    EXPECT_EQ(counts.negative_lobes + counts.over_long + counts.unconverged, 0U);
  }
}

TEST(Codec, CountsNegativeLobesAndOverLongVectors) {
  const BasisSet set = flat_and_rnm();
  const auto codec = make_codec({"sh2"}, set);
  // A sun near the horizon: rnm0 alone sees much of it; opposite, a + v.n is far below 0.
  const auto low = encoded(*codec, bakes({{Vec3d(1, 0, 0.1).normalized(), 1}}, set)).counts;
  EXPECT_EQ(low.negative_lobes, 1U);
  // A sun straight up: a is 0, and v is not.
  const auto high = encoded(*codec, bakes({{Vec3d(0, 0, 1), 1}}, set)).counts;
  EXPECT_EQ(high.over_long, 1U);
  EXPECT_EQ(high.negative_lobes, 0U);
  EncodeCounts both = low;
  both += high;
  EXPECT_EQ(both.texels, 2U);
  EXPECT_EQ(both.negative_lobes, 1U);
}

}  // namespace
}  // namespace rnmbake
