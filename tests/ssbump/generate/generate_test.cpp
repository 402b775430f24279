#include "ssbump/generate/generate.h"

#include "base/error.h"
#include "ssbump/height_fields.h"
#include "ssbump/heights/trace_heights.h"

#include <limits>

#include <gtest/gtest.h>

using namespace rnmbake;

namespace {

GenerateOptions by(SsbumpMethod method, int rays) {
  GenerateOptions options;
  options.method = method;
  options.rays = rays;
  return options;
}

TEST(Generate, RaysAndHorizonsAgree) {
  const HeightField field = rough_field(128, 4, WrapMode::wrap, 8);
  constexpr int rays = 2048;
  const FloatImage traced = generate(field, by(SsbumpMethod::trace, rays)).image;
  const FloatImage swept = generate(field, {}).image;
  double sum = 0, largest = 0;
  for (std::size_t i = 0; i < traced.data().size(); ++i) {
    const double difference = double(traced.data()[i]) - swept.data()[i];
    sum += difference;
    largest = std::max(largest, std::abs(difference));
  }
  // A ray's share of a weight is at most 2 / rays (of the mean), and blocked or not is a coin of error 1/2 at
  // most
  const double error = 1 / std::sqrt(double(rays));
  EXPECT_LE(largest, 4 * error);
  EXPECT_LE(std::abs(sum) / double(traced.data().size()),
            0.001 + 4 * error / std::sqrt(double(field.heights.texels())));
}

TEST(Generate, ConesAreWholeOnAFlatMapAndHalfAtAWall) {
  const FloatImage flat =
      generate(field_of(4, 4, WrapMode::wrap, [](int, int) { return 1; }), by(SsbumpMethod::cone, 250)).image;
  for (const float weight : flat.data()) EXPECT_EQ(weight, 1);

  const HeightField step = field_of(8, 3, WrapMode::none, [](int x, int) { return x < 4 ? 0 : 200; });
  constexpr int rays = 8192;
  const FloatImage cut = generate(step, by(SsbumpMethod::cone, rays)).image;
  EXPECT_NEAR(cut.texel(3, 1)[SsbumpWeights::up], 0.5, 4 * 0.5 / std::sqrt(rays / 2.0));
  EXPECT_LT(cut.texel(3, 1)[0], 0.2F);  // looks into the wall
  EXPECT_GT(cut.texel(3, 1)[1], 0.6F);  // looks away from it
  EXPECT_NEAR(cut.texel(3, 1)[1], cut.texel(3, 1)[2], 8 * 0.5 / std::sqrt(rays / 4.0));
}

TEST(Generate, ReflectionsGoWithTheAlbedo) {
  const HeightField groove = field_of(32, 4, WrapMode::wrap, [](int x, int) { return std::abs(x - 16); });
  GenerateOptions options = by(SsbumpMethod::horizon, 64);
  const FloatImage dark = generate(groove, options).image;
  options.bounces = 1;
  options.albedo = 0.4F;
  const FloatImage grey = generate(groove, options).image;
  options.albedo = 0.8F;
  const FloatImage bright = generate(groove, options).image;
  for (std::size_t i = 0; i < dark.data().size(); ++i) {
    const float less = grey.data()[i] - dark.data()[i], more = bright.data()[i] - dark.data()[i];
    ASSERT_NEAR(more, 2 * less, 1e-5);
    ASSERT_GE(less, 0);
  }
  EXPECT_GT(grey.texel(16, 1)[3] - dark.texel(16, 1)[3], 0.02F);
  options.bounces = 3;
  EXPECT_GT(generate(groove, options).image.texel(16, 1)[3], bright.texel(16, 1)[3]);
}

TEST(Generate, AMapOfOneAlbedoIsThatAlbedo) {
  const HeightField field = rough_field(16, 16, WrapMode::wrap, 6);
  GenerateOptions options = by(SsbumpMethod::horizon, 32);
  options.bounces = 2;
  options.albedo = 0.3F;
  const FloatImage plain = generate(field, options).image;
  FloatImage map(16, 16, 1);
  std::ranges::fill(map.data(), 0.3F);
  options.albedo_map = &map;
  EXPECT_EQ(plain.data(), generate(field, options).image.data());
}

TEST(Generate, SaysWhatItCannotUse) {
  HeightField field = rough_field(8, 8, WrapMode::wrap, 6);
  GenerateOptions options;
  options.power = 0;
  EXPECT_THROW((void)generate(field, options), Error);
  field.heights.texel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW((void)generate(field, {}), Error);
  EXPECT_THROW((void)generate(HeightField{}, {}), Error);
}

TEST(HeightTracer, MeetsWhatCastsTheShadow) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    const HeightField field = rough_field(24, 20, beyond, 12);
    const HeightTracer tracer(field);
    const HeightRays shadows(field);
    int unlike = 0;
    for (int i = 0; i < 4000; ++i) {
      const int x = static_cast<int>(unit(random) * 24), y = static_cast<int>(unit(random) * 20);
      const double z = 0.02 + 0.97 * unit(random), angle = 2 * pi * unit(random), r = std::sqrt(1 - z * z);
      const Vec3d direction(r * std::cos(angle), r * std::sin(angle), z);
      const auto hit = tracer.next(tracer.centre(x, y), direction);
      unlike += hit.has_value() != shadows.occluded(x, y, Vec3(direction));
      if (hit) {
        EXPECT_LT(hit->normal.dot(direction), 1e-3);
      }
    }
    EXPECT_LE(unlike, 4);  // rays that graze
  }
}

}  // namespace
